#!/bin/sh
# usage: coverage.sh BUILD SECONDS
# Builds the readers with clang's libFuzzer, AddressSanitizer and UBSan, and runs each kind of input for SECONDS. What it learns stays in
# BUILD/corpus for the next time. Exit code 77: no clang with libFuzzer here.
set -u
build=$1 seconds=$2
compiler=$(command -v clang++) || { echo "skipped: no clang++; Debian's packages are clang and libclang-rt-dev"; exit 77; }
mkdir -p "$build" && build=$(cd "$build" && pwd) || exit 1
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' >"$build/try.cpp"
"$compiler" -fsanitize=fuzzer,address "$build/try.cpp" -o "$build/try" || { echo "skipped: $compiler has no libFuzzer; Debian's package is libclang-rt-dev"; exit 77; }
cmake --preset libfuzzer -B "$build" -DCMAKE_CXX_COMPILER="$compiler" && cmake --build "$build" --target libfuzzer_inputs || exit 1
failed=
for kind in json csv yml xml line; do
	export TILT_LENS_FUZZ_KIND=$kind
	corpus=$build/corpus/$kind
	mkdir -p "$corpus" "$build/found"
	"$build/tests/bin/libfuzzer_inputs" --seeds "$corpus" || exit 1
	# What others allocated while they were parsed is theirs: leaks are looked for, but not by every input.
	"$build/tests/bin/libfuzzer_inputs" -max_total_time="$seconds" -timeout=20 -max_len=20000 -rss_limit_mb=4096 -print_final_stats=1 \
		-artifact_prefix="$build/found/$kind-" "$corpus" >"$build/$kind.log" 2>&1 || failed="$failed $kind"
	echo "$kind: $(sed -n 's/^stat::number_of_executed_units: *//p' "$build/$kind.log") runs, $(ls "$corpus" | wc -l) in the corpus"
done
[ -z "$failed" ] || { echo "failed:$failed; see $build/KIND.log, inputs in $build/found"; exit 1; }
echo "json, csv, yml, xml and line, $seconds s each: no failure"
