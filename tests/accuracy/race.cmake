# The race: what accuracy costs, against stock POV-Ray. Included by this folder's CMakeLists.txt.
#
#   cmake --build --preset accuracy          the whole race, and out/accuracy/report.html
#   cmake --build --preset accuracy-quick    the race alone, in small pictures: a quarter of an hour
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)
set(TILT_LENS_RACE_JOBS 2 CACHE STRING "Scenes that are raced at a time; no more than there are cores")

add_executable(race EXCLUDE_FROM_ALL race.cpp race_contest.cpp race_curve.cpp race_errors.cpp race_plot.cpp race_process.cpp
	race_render.cpp race_report.cpp race_setting.cpp race_tables.cpp)
target_include_directories(race PRIVATE "${PROJECT_SOURCE_DIR}/tests/render")
target_include_directories(race SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
target_link_libraries(race PRIVATE render_test_support opencv_core opencv_imgproc opencv_imgcodecs CLI11::CLI11
	nlohmann_json::nlohmann_json fmt::fmt Threads::Threads tilt_lens_warnings)

add_executable(race_nothing EXCLUDE_FROM_ALL race_nothing.cpp callgrind.cpp race_curve.cpp race_process.cpp)
target_include_directories(race_nothing PRIVATE "${PROJECT_SOURCE_DIR}/tests/render")
target_link_libraries(race_nothing PRIVATE render_test_support CLI11::CLI11 fmt::fmt tilt_lens_warnings)

set(nothing_command race_nothing --only-report --ours "${CMAKE_BINARY_DIR}/bin/povray" --stock "${TILT_LENS_STOCK_POVRAY}"
	--scenes "${CMAKE_CURRENT_SOURCE_DIR}/scenes" --work "${CMAKE_BINARY_DIR}/race/nothing" --out "${PROJECT_SOURCE_DIR}/out/accuracy")
set(race_command race --ours "${CMAKE_BINARY_DIR}/bin/povray" --stock "${TILT_LENS_STOCK_POVRAY}"
	--scenes "${CMAKE_CURRENT_SOURCE_DIR}/scenes" --settings "${CMAKE_CURRENT_SOURCE_DIR}/race_settings.json"
	--work "${CMAKE_BINARY_DIR}/race" --out "${PROJECT_SOURCE_DIR}/out/accuracy" --jobs "${TILT_LENS_RACE_JOBS}")
set(calibrator_command calibrator_cost --photos "${PROJECT_SOURCE_DIR}/scenes/boxes/photos/target" --out "${PROJECT_SOURCE_DIR}/out/accuracy")
set(ablation_command calibrator_ablation --photos "${TILTCAL_ABLATION_PHOTOS}" --out "${PROJECT_SOURCE_DIR}/out/accuracy")
set(tiltcost_command tiltcost_predictions --tiltcost "$<TARGET_FILE:tiltcost>" --povray "${CMAKE_BINARY_DIR}/bin/povray"
	--race-scenes "${CMAKE_CURRENT_SOURCE_DIR}/scenes" --scenes "${PROJECT_SOURCE_DIR}/scenes" --out "${PROJECT_SOURCE_DIR}/out/accuracy")
# What is out of its bounds is said in the report, which is made all the same.
add_custom_target(accuracy COMMAND ${nothing_command} COMMAND ${calibrator_command} COMMAND ${ablation_command} COMMAND ${tiltcost_command} || "${CMAKE_COMMAND}" -E true
	COMMAND ${race_command} DEPENDS povray USES_TERMINAL VERBATIM COMMENT "out/accuracy/report.html (about an hour)")
add_custom_target(accuracy-quick COMMAND ${race_command} --quick DEPENDS povray USES_TERMINAL VERBATIM COMMENT "The race, quick")
