#!/usr/bin/env python3
# SPDX-License-Identifier: AGPL-3.0-or-later
"""calibration.json against its schema, and the schema against its page.

    json_schema.py validate SCHEMA FILE...    every file is as the schema says
    json_schema.py mutants SCHEMA FILE...     and is refused with a key less, a key more, or a value of another type
    json_schema.py documented SCHEMA PAGE     the page has a section for every object, and in its tables just the object's keys
"""
import json
import re
import sys

import jsonschema

# Keys that a file may lack; all others are refused when they are gone.
OPTIONAL = {
    "blades", "priors", "correlations", "real_lens", "scene_lens", "held_out_blur_px", "vignetting/optical", "vignetting/optical/rims", "vignetting/optical/second",
    "tilt_told_by/blur_alone", "tilt_told_by/geometry_alone", "board_check", "focus_check", "untilted_check", "untilted_check/by_places", "photographs/0/fits_state", "photographs/0/same_as",
    "thin_model", "states/0/thin", "next_photographs", "stops", "render/stops", "real_lens/stops", "scene_lens/stops", "scene_lens/rms_asymmetry", "scene_lens/rms_hollowness", "states/0/photos/0/f_number", "render/states/0/photos/0/f_number",
}
# Objects whose keys are names, each of which may be missing.
MAPS = re.compile(r"^(priors|held_out_blur_px|correlations(/.*)?|((real|scene)_lens/)?(covariance(/.*)?|sigma_by_photographs)|tilt_told_by/(blur|geometry)_alone)$")
# Lists of two entries at least, which are not shortened to one.
PAIRS = ("stops",)
# Lists of words, of any length.
WORDS = re.compile(r"^next_photographs/(missing|photographs/\d+/states)$")


def read(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def validator(name):
    schema = read(name)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def place(error):
    return "/".join(map(str, error.absolute_path)) or "top level"


def validate(schema, files):
    faults = [f"{name}: {place(e)}: {e.message[:300]}" for name in files for e in validator(schema).iter_errors(read(name))]
    print(f"{len(files)} files, {len(faults)} faults")
    return faults


def shortened(value):
    """Lists of objects by their first entry: the others are of the same kind."""
    if isinstance(value, dict):
        return {key: [shortened(v) for v in value[key][:2]] if key in PAIRS else shortened(v) for key, v in value.items()}
    if isinstance(value, list):
        return [shortened(v) for v in (value[:1] if value and isinstance(value[0], dict) else value)]
    return value


def nodes(value, path=()):
    yield path, value
    for key, v in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from nodes(v, path + (key,))


def at(value, path):
    for key in path:
        value = value[key]
    return value


def mutants_of(whole):
    """(what was done, changed copy), one at a time."""
    for path, value in nodes(whole):
        name = "/".join(map(str, path))
        if isinstance(value, dict):
            copy = json.loads(json.dumps(whole))
            at(copy, path)["undocumented"] = "text"
            yield f"{name}: a key more", copy
        if path:
            copy = json.loads(json.dumps(whole))
            at(copy, path[:-1])[path[-1]] = "text" if isinstance(value, (dict, list)) else {}
            yield f"{name}: of another type", copy
            parent = "/".join(map(str, path[:-1]))
            is_map = MAPS.match(parent) and not (parent.startswith("tilt_told_by") and str(path[-1]).startswith("pupil_magnification"))
            if name not in OPTIONAL and not is_map and not WORDS.match(parent):
                copy = json.loads(json.dumps(whole))
                del at(copy, path[:-1])[path[-1]]
                # Lists may be of any length, but for vectors.
                if isinstance(at(whole, path[:-1]), dict) or not isinstance(value, dict):
                    yield f"{name}: gone", copy


def mutants(schema, files):
    check = validator(schema)
    faults, count = [], 0
    for name in files:
        whole = shortened(read(name))
        faults += [f"{name}, shortened: {place(e)}: {e.message}" for e in check.iter_errors(whole)]
        for what, copy in mutants_of(whole):
            count += 1
            if check.is_valid(copy):
                faults.append(f"{name}: passes with {what}")
    print(f"{count} mutants, {len(faults)} faults")
    return faults if count > 100 else faults + ["hardly any mutants were made"]


def sections(page):
    """Heading -> keys in the columns `key` and `σ key` of the section's tables."""
    found, heading, columns = {}, None, []
    with open(page, encoding="utf-8") as file:
        for line in file:
            if match := re.match(r"#+ (.*)", line):
                heading, columns = match[1].strip(), []
            elif not line.startswith("|"):
                columns = []
            else:
                cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
                if not columns:
                    columns = [i for i, cell in enumerate(cells) if cell in ("key", "σ key")]
                else:
                    found.setdefault(heading, []).extend(key for i in columns if i < len(cells) for key in re.findall(r"`([^`]+)`", cells[i]))
    return found


def documented(schema, page):
    faults, count = [], 0
    on_page = sections(page)
    for name, part in read(schema)["$defs"].items():
        if "properties" not in part:
            continue
        title = part.get("title", "")
        keys = on_page.pop(title, [])
        count += len(part["properties"])
        faults += [f"{page}: section '{title}' does not name {key} ($defs/{name})" for key in part["properties"] if key not in keys]
        faults += [f"{page}: section '{title}' names {key}, which $defs/{name} does not have" for key in keys if key not in part["properties"]]
        faults += [f"{page}: section '{title}' names {key} twice" for key in set(keys) if keys.count(key) > 1]
        # An object in an object needs a section too: its keys must be of a $defs entry.
        for key, value in part["properties"].items():
            if "properties" in json.dumps(value).replace("additionalProperties", "").replace("unevaluatedProperties", ""):
                faults.append(f"{schema}: $defs/{name}: {key}: give its object an entry of $defs, and a title")
    faults += [f"{page}: section '{heading}' is of no object of the schema" for heading, keys in on_page.items() if keys]
    print(f"{count} keys, {len(faults)} faults")
    return faults if count > 100 else faults + ["the schema has hardly any keys"]


def main():
    what, schema, *files = sys.argv[1:]
    faults = {"validate": validate, "mutants": mutants}[what](schema, files) if what != "documented" else documented(schema, *files)
    print("\n".join(faults))
    return 1 if faults else 0


sys.exit(main())
