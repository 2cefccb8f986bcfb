# write_summary(OUT STATES): OUT/summary.md from OUT/calibration/calibration.json and OUT/profiles/*.json, with the
# paper's own figures beside ours.

include("${CMAKE_CURRENT_LIST_DIR}/../cmake/tables.cmake")

function(write_summary OUT STATES)
	# True tilt and the paper's own results: its Table 1 (Canon TS-E 45 mm) and Table 2.
	set(true_untilted "0.000")
	set(true_plus5 "5.000")
	set(true_minus5 "-5.000")
	set(paper1_untilted "–")
	set(paper1_plus5 "4.152")
	set(paper1_minus5 "-5.030")
	set(paper2_untilted "16.49 / 11.49")
	set(paper2_plus5 "16.42 / 11.16")
	set(paper2_minus5 "6.474 / 7.851")

	file(READ "${OUT}/calibration/calibration.json" calibration)
	string(JSON model GET "${calibration}" model)
	string(JSON paper ERROR_VARIABLE missing GET "${calibration}" comparison paper)
	table_head(tilts "state" "true" "`paper` model" "`${model}` model" "its σ" "direction" "the paper's own result")
	foreach(state IN LISTS STATES)
		state_value("${paper}" ${state} lens_tilt_deg by_paper)
		state_value("${calibration}" ${state} lens_tilt_deg found)
		state_value("${calibration}" ${state} lens_tilt_sigma_deg sigma)
		state_value("${calibration}" ${state} tilt_direction_deg direction)
		table_row(tilts ${state} "${true_${state}}" "${by_paper}" "${found}" "${sigma}" "${direction}" "${paper1_${state}}")
	endforeach()
	table_head(errors "state" "`--match shading`" "`--match gain`" "the paper" "whole picture, gain: RMS")
	table_head(pictures "state" "photograph and render" "profiles")
	foreach(state IN LISTS STATES)
		line_errors("${OUT}/profiles/${state}-shading.json" shading)
		line_errors("${OUT}/profiles/${state}-gain.json" gain)
		file(READ "${OUT}/profiles/${state}-gain.json" json)
		string(JSON rms GET "${json}" rms_error)
		three_digits("${rms}" rms)
		table_row(errors ${state} "${shading}" "${gain}" "${paper2_${state}}" "${rms}")
		table_row(pictures ${state} "[side by side](side-by-side-${state}.png)" "[red and green line](profile-${state}.png)")
	endforeach()
	file(WRITE "${OUT}/summary.md" "# Photographs in, matching render out\n\n## Table 1: lens tilt, degrees\n\n${tilts}"
		"\nOther lens, other photographs than the paper's: its figures show the size of its errors. σ holds the noise and how far photographs and parts of the edges differ. "
		"This lens has field curvature; the plane that fits its best focus corresponds to 5.4 to 5.6 degrees.\n\n"
		"## Table 2: mean brightness error, photograph against render, of 255, red / green line\n\n"
		"${errors}"
		"\nRed: row 660. Green: column 900. `shading` divides out what is left of a smooth shading; `gain` brings both to one exposure and no more. The renders have ${SAMPLES} lens samples a pixel and are denoised.\n\n"
		"${pictures}")
endfunction()
