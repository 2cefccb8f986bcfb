# What every script of the scenes begins with and runs its programs by.
#
# need(NAME...)            ends the script when one was not given with -DNAME=...
# defaults(NAME=VALUE...)  for those that were not given
# say(TEXT)                a line with the script's name and the seconds so far
# step(TEXT)               the same; what the step before took goes to the file STEP_TIMES, if that is set
# run([LOG FILE | SAID VARIABLE] [FOLDER WHERE] COMMAND ...)   ends the script when it fails, with what it said
include_guard(GLOBAL)
get_filename_component(script_name "${CMAKE_SCRIPT_MODE_FILE}" NAME_WE)
string(TIMESTAMP script_started "%s" UTC)
set(step_text "")

function(need)
	foreach(name IN LISTS ARGN)
		if(NOT DEFINED ${name})
			message(FATAL_ERROR "${script_name}.cmake needs -D${name}=...")
		endif()
	endforeach()
endfunction()

macro(defaults)
	foreach(pair ${ARGN})
		string(REGEX MATCH "([^=]*)=(.*)" ignored "${pair}")
		if(NOT DEFINED ${CMAKE_MATCH_1})
			set(${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
		endif()
	endforeach()
endmacro()

# seconds_since(TIME RESULT): TIME as string(TIMESTAMP ... "%s") gives it.
function(seconds_since time result)
	string(TIMESTAMP now "%s" UTC)
	math(EXPR seconds "${now} - ${time}")
	set(${result} ${seconds} PARENT_SCOPE)
endfunction()

function(say text)
	seconds_since(${script_started} seconds)
	message("[${script_name} ${seconds} s] ${text}")
endfunction()

macro(step text)
	if(STEP_TIMES AND NOT step_text STREQUAL "")
		seconds_since(${step_started} step_seconds)
		file(APPEND "${STEP_TIMES}" "${step_seconds} ${step_text}\n")
	endif()
	say("${text}")
	string(TIMESTAMP step_started "%s" UTC)
	set(step_text "${text}")
endmacro()

function(run)
	cmake_parse_arguments(PARSE_ARGV 0 arg "" "LOG;SAID;FOLDER" "COMMAND")
	set(where OUTPUT_VARIABLE text ERROR_VARIABLE text)
	if(arg_LOG)
		get_filename_component(folder "${arg_LOG}" DIRECTORY)
		file(MAKE_DIRECTORY "${folder}")
		set(where OUTPUT_FILE "${arg_LOG}" ERROR_FILE "${arg_LOG}")
	endif()
	if(arg_FOLDER)
		list(APPEND where WORKING_DIRECTORY "${arg_FOLDER}")
	endif()
	execute_process(COMMAND ${arg_COMMAND} ${where} RESULT_VARIABLE failed)
	if(failed)
		if(arg_LOG)
			file(READ "${arg_LOG}" text)
		endif()
		list(JOIN arg_COMMAND " " command)
		message(FATAL_ERROR "${text}\n${command}\nfailed: ${failed}")
	endif()
	if(arg_SAID)
		set(${arg_SAID} "${text}" PARENT_SCOPE)
	endif()
endfunction()
