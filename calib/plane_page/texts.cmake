# The page's files as C++ strings:  cmake -DFOLDER=... -DOUT=... -DSCRIPTS=optics.js,... -P texts.cmake
cmake_minimum_required(VERSION 3.25)

set(scripts "")
string(REPLACE "," ";" SCRIPTS "${SCRIPTS}")
foreach(file IN LISTS SCRIPTS)
	file(READ "${FOLDER}/${file}" text)
	string(APPEND scripts "${text}")
endforeach()
file(READ "${FOLDER}/style.css" style)
file(READ "${FOLDER}/page.css" page)
file(WRITE "${OUT}.new" "// Made by texts.cmake.\n#include \"plane_page/texts.h\"\n\nnamespace tiltcal\n{\n
const char* const PlaneStyleText = R\"PLANE(${style})PLANE\";
const char* const PlanePageStyleText = R\"PLANE(${page})PLANE\";
const char* const PlaneScriptText = R\"PLANE(${scripts})PLANE\";\n\n}\n")
file(RENAME "${OUT}.new" "${OUT}")
