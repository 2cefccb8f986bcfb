# Warnings, sanitizers and ccache for our own targets.

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
	set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
	set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

add_library(tilt_lens_warnings INTERFACE)
target_compile_options(tilt_lens_warnings INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
if(TILT_LENS_WERROR)
	target_compile_options(tilt_lens_warnings INTERFACE -Werror)
endif()

set(TILT_LENS_SANITIZER_FLAGS "")
if(TILT_LENS_SANITIZE)
	set(TILT_LENS_SANITIZER_FLAGS -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
	add_compile_options(${TILT_LENS_SANITIZER_FLAGS})
	add_link_options(${TILT_LENS_SANITIZER_FLAGS})
	# Eigen allocates in a way of its own under the sanitizer; Ceres is compiled without it, and frees what its templates, merged with ours, allocated.
	add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Coverage for libFuzzer (tests/fuzz/coverage.sh), which only clang has.
if(TILT_LENS_LIBFUZZER)
	if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
		message(FATAL_ERROR "TILT_LENS_LIBFUZZER needs clang: -DCMAKE_CXX_COMPILER=clang++")
	endif()
	add_compile_options(-fsanitize=fuzzer-no-link)
	add_link_options(-fsanitize=fuzzer-no-link)
endif()
