# The installed library from outside: a program that knows nothing of this tree finds it with find_package, calibrates the demo's
# photographs and prints what tiltcal's calibration.json has; on stderr nothing, and no name of an option.
#
#   cmake -DBUILD= -DSOURCE= -DPHOTOS= -DCALIBRATION= -DWORK= -P outside.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(COPY "${SOURCE}/" DESTINATION "${WORK}/source")
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${WORK}/source" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${prefix}"
	OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${WORK}/build" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK}/build/tilts" "${PHOTOS}" OUTPUT_VARIABLE out ERROR_VARIABLE errors COMMAND_ERROR_IS_FATAL ANY)
message(STATUS "\n${out}")
if(errors)
	message(FATAL_ERROR "the library wrote on stderr:\n${errors}")
endif()

file(READ "${CALIBRATION}/calibration.json" json)
foreach(index 0 1 2)
	string(JSON name GET "${json}" states ${index} name)
	string(JSON tilt GET "${json}" states ${index} lens_tilt_deg)
	if(NOT out MATCHES "${name} tilt ([-0-9.]+) ")
		message(FATAL_ERROR "no tilt of ${name} in:\n${out}")
	endif()
	set(said "${CMAKE_MATCH_1}")
	# Rounded to four digits, as printed; the fit's threads add in an order of their own, which moves the ninth.
	execute_process(COMMAND awk "BEGIN { d = ${said} - ${tilt}; exit !(d < 0.0001 && d > -0.0001) }" RESULT_VARIABLE differs)
	if(differs)
		message(FATAL_ERROR "${name}: the library says ${said}, tiltcal ${tilt}")
	endif()
	# Unproject and Project are each other's inverse to the iteration's 1e-9 of w, 2416 px.
	if(NOT out MATCHES "${name} sees \\(300, 200\\) at \\((300\\.0000|299\\.9999)[0-9]*, (200\\.0000|199\\.9999)")
		message(FATAL_ERROR "${name}: Project does not undo Unproject:\n${out}")
	endif()
endforeach()
# The block that tiltcal writes into its files, with numbers instead of names.
foreach(words "camera {" "tilt_lens {" "lens_tilt 5.0" "aperture_diameter 15.9" "distortion -0.09" "vignetting natural" "blur_samples TiltCal_Blur_Samples")
	string(FIND "${out}" "${words}" at)
	if(at LESS 0)
		message(FATAL_ERROR "the camera block lacks '${words}':\n${out}")
	endif()
endforeach()

# Private things stay private.
execute_process(COMMAND nm -DC --defined-only "${prefix}/lib/libtiltcal.so" OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
if(failed)
	file(GLOB_RECURSE library "${prefix}/libtiltcal.so")
	execute_process(COMMAND nm -DC --defined-only ${library} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
endif()
if(NOT symbols MATCHES "tiltcal::Calibrate\\(" OR symbols MATCHES "tiltcal::SolveGeometry|tiltcal::FitEdge|tiltcal::JointFit")
	message(FATAL_ERROR "libtiltcal.so shows the wrong symbols")
endif()
file(REMOVE_RECURSE "${WORK}")
