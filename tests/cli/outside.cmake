# The installed library from outside: a program that knows nothing of this tree finds it with find_package, calibrates the demo's
# photographs and prints what tiltcal's calibration.json has; on stderr nothing, and in what is thrown no name of an option.
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

# The blur of (300, 200) at 700 mm in the untilted state, by the formula: w d |1/z - 1/U - C tan^2|, w in px. 2 %: the distortion turns
# the direction by k1 r^2 = 0.8 % of r, which is twice that of tan^2, a fifth of the whole.
foreach(key image_distance_mm aperture_diameter_mm focus_distance_mm field_curvature_per_mm)
	string(JSON ${key} GET "${json}" ${key})
endforeach()
string(JSON u GET "${json}" principal_point_px 0)
string(JSON v GET "${json}" principal_point_px 1)
string(REGEX MATCH "untilted sees [^\n]*, blurred by ([0-9.]+) px" line "${out}")
execute_process(COMMAND awk "BEGIN { w = ${image_distance_mm} / 0.02; t2 = ((300 - ${u})^2 + (200 - ${v})^2) / w^2
	b = w * ${aperture_diameter_mm} * (1 / 700 - 1 / ${focus_distance_mm} - ${field_curvature_per_mm} * t2); b = b < 0 ? -b : b
	print b; d = ${CMAKE_MATCH_1} / b - 1; exit !(d < 0.02 && d > -0.02) }" OUTPUT_VARIABLE expected RESULT_VARIABLE differs)
if(differs)
	message(FATAL_ERROR "the blur is ${CMAKE_MATCH_1} px, by the formula ${expected}")
endif()

# What goes wrong is an Error, in words without a command line's.
execute_process(COMMAND "${WORK}/build/tilts" nowhere OUTPUT_VARIABLE nothing ERROR_VARIABLE errors RESULT_VARIABLE code)
if(NOT code EQUAL 3 OR NOT errors MATCHES "nowhere/untilted-1.jpg" OR errors MATCHES "--" OR NOT nothing STREQUAL "")
	message(FATAL_ERROR "of a missing photograph: exit ${code}, said: ${errors}${nothing}")
endif()

# Private things stay private: what is shown is in include/tiltcal.
file(GLOB_RECURSE library "${prefix}/libtiltcal.so")
execute_process(COMMAND nm -DC --defined-only ${library} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " T tiltcal::[A-Za-z:]+" shown "${symbols}")
list(REMOVE_DUPLICATES shown)
file(GLOB headers "${prefix}/include/tilt-lens/tiltcal/*.h")
set(text "")
foreach(header IN LISTS headers)
	file(READ "${header}" part)
	string(APPEND text "${part}")
endforeach()
foreach(symbol IN LISTS shown)
	string(REGEX REPLACE "^.*::" "" name "${symbol}")
	if(NOT text MATCHES "[^A-Za-z]${name}\\(")
		message(FATAL_ERROR "libtiltcal.so shows${symbol}, which no public header declares")
	endif()
endforeach()
if(NOT shown MATCHES "tiltcal::Calibrate(;|$)")
	message(FATAL_ERROR "libtiltcal.so does not show tiltcal::Calibrate")
endif()
file(REMOVE_RECURSE "${WORK}")
