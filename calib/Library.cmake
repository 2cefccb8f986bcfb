# The library for other programs: find_package(tiltcal) after `cmake --install`, target tiltcal::tiltcal. The rooms up to camera in
# one shared library, so that a program that uses it needs neither Ceres nor OpenCV to build. Public: include/tiltcal, and the
# vector of lens/vec3.h.
include(CMakePackageConfigHelpers)

# Their objects; and the rooms themselves for what they link.
list(TRANSFORM TILTCAL_LIBRARY_ROOMS REPLACE "(.+)" "$<TARGET_OBJECTS:tiltcal_\\1>" OUTPUT_VARIABLE objects)
list(TRANSFORM TILTCAL_LIBRARY_ROOMS PREPEND tiltcal_ OUTPUT_VARIABLE library_rooms)
add_library(tiltcal_library SHARED ${objects})
set_target_properties(tiltcal_library PROPERTIES OUTPUT_NAME tiltcal EXPORT_NAME tiltcal VERSION "${PROJECT_VERSION}" SOVERSION 0 LINKER_LANGUAGE CXX)
target_link_libraries(tiltcal_library PRIVATE ${library_rooms})
target_compile_features(tiltcal_library INTERFACE cxx_std_17)
set(TILTCAL_INCLUDEDIR "${CMAKE_INSTALL_INCLUDEDIR}/tilt-lens")
target_include_directories(tiltcal_library INTERFACE "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>"
	"$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/povray-patch>" "$<INSTALL_INTERFACE:${TILTCAL_INCLUDEDIR}>")

install(TARGETS tiltcal_library EXPORT tiltcalTargets LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY include/tiltcal DESTINATION "${TILTCAL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h")
install(FILES "${PROJECT_SOURCE_DIR}/povray-patch/lens/vec3.h" DESTINATION "${TILTCAL_INCLUDEDIR}/lens")
install(EXPORT tiltcalTargets NAMESPACE tiltcal:: FILE tiltcalConfig.cmake DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/tiltcal")
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/tiltcalConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/tiltcalConfigVersion.cmake" DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/tiltcal")
