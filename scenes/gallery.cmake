# Every picture of the scenes, by the commands of their documents, and a page that shows them.
#
#   cmake -DPOVRAY= -DSCENES=<this folder> -DOUT= [-DONLY=city;sweep] -P gallery.cmake
#
# A command is a line of a README that starts with "    build/release/bin/povray scenes/". Its picture goes to
# OUT/<folder>/ instead of scenes/<folder>/; the caption is the text of the README's ![caption](picture). A command
# without +O is left out, one that writes below out/ runs as it stands. OUT receives index.html.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/cmake/script.cmake")
need(POVRAY SCENES OUT)
if(NOT DEFINED ONLY)
	set(ONLY dragons landscape city product sweep effects aberrations first-tilt show-focus show-plane denoise)
endif()
cmake_path(GET SCENES PARENT_PATH ROOT)

function(escape variable text)
	string(REPLACE "&" "&amp;" text "${text}")
	string(REPLACE "<" "&lt;" text "${text}")
	string(REPLACE ">" "&gt;" text "${text}")
	string(REPLACE "`" "" text "${text}")
	set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# The caption of a picture that a README shows.
function(caption_of variable folder file)
	file(READ "${SCENES}/${folder}/README.md" text)
	string(REPLACE "." "\\." pattern "${file}")
	if(NOT text MATCHES "!\\[([^]]*)\\]\\(${pattern}\\)")
		message(FATAL_ERROR "${SCENES}/${folder}/README.md makes ${file} but does not show it: add ![caption](${file})")
	endif()
	set(${variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# The commands first, for the count, and every caption before minutes go by.
set(folders) # one entry a command, as in lines
set(lines)
foreach(folder IN LISTS ONLY)
	file(STRINGS "${SCENES}/${folder}/README.md" found REGEX "^    build/release/bin/povray scenes/.* \\+O")
	if(NOT found)
		message(FATAL_ERROR "${SCENES}/${folder}/README.md has no command that makes a picture")
	endif()
	foreach(line IN LISTS found)
		list(APPEND folders ${folder})
		list(APPEND lines "${line}")
		if(line MATCHES "\\+Oscenes/${folder}/([^ ]+)")
			caption_of(ignored ${folder} "${CMAKE_MATCH_1}")
		endif()
	endforeach()
endforeach()
list(LENGTH lines count)

set(page "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">
<title>tilt_lens: gallery</title>
<style>
body { background: #16181c; color: #d8d8d4; font: 16px/1.5 sans-serif; margin: 2em auto; max-width: 1700px; padding: 0 1.5em }
h2 { font-weight: 500; border-bottom: 1px solid #444; margin-top: 2em }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 620px), 1fr)); gap: 1.5em }
figure { margin: 0 } img { width: 100%; display: block; border-radius: 4px }
figcaption { padding: .5em 0 0 } small, code { color: #9a9a94; overflow-wrap: anywhere }
</style>\n<h1>tilt_lens: gallery</h1>\n")
set(section "")
set(number 0)
foreach(folder line IN ZIP_LISTS folders lines)
	math(EXPR number "${number} + 1")
	string(STRIP "${line}" line)
	separate_arguments(words UNIX_COMMAND "${line}")
	list(POP_FRONT words program scene)
	string(REGEX MATCH "\\+O([^ ]+)" ignored "${line}")
	set(target "${CMAKE_MATCH_1}")
	if(target MATCHES "^scenes/")
		string(REGEX REPLACE "^scenes/" "${OUT}/" picture "${target}")
	else()
		set(picture "${ROOT}/${target}")
	endif()
	list(TRANSFORM words REPLACE "^\\+O.*" "+O${picture}")
	cmake_path(GET picture PARENT_PATH where)
	cmake_path(GET picture FILENAME file)
	file(MAKE_DIRECTORY "${where}")

	string(TIMESTAMP before "%s" UTC)
	run(FOLDER "${ROOT}" COMMAND "${POVRAY}" ${scene} ${words} -D)
	seconds_since(${before} seconds)
	say("picture ${number} of ${count}: ${folder}/${file}, ${seconds} s")

	if(target MATCHES "^scenes/")
		caption_of(caption ${folder} "${file}")
		escape(caption "${caption}")
		escape(command "${line}")
		if(NOT section STREQUAL folder)
			if(section)
				string(APPEND page "</main>\n")
			endif()
			string(APPEND page "<h2>${folder}</h2>\n<main>\n")
			set(section ${folder})
		endif()
		string(APPEND page "<figure><a href=\"${folder}/${file}\"><img src=\"${folder}/${file}\" alt=\"${caption}\"></a>"
			"<figcaption>${caption} <small>(${seconds} s)</small><details><summary><small>command</small></summary>"
			"<code>${command}</code></details></figcaption></figure>\n")
	endif()
endforeach()
file(WRITE "${OUT}/index.html" "${page}</main>\n</html>\n")
say("done: ${OUT}/index.html")
