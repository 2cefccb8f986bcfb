# SPDX-License-Identifier: AGPL-3.0-or-later
"""A submission's folder:

  submission.json  what is rendered and how; written once
  cut.json         its units, a frame's rows each, and which unit belongs to which task; written once, by the pilot
  parts/           a picture and a record of each unit that is done
  log/             what Slurm's jobs and POV-Ray say
  joined.json      the pictures that were joined, as they were then
  jobs.json        Slurm's ids
"""
import os
import secrets
import time

from common import Failure, digest, file_error, read_json, refused, write_json


def create(output, values):
	"""A new folder beside the picture, which no other submission has."""
	stem = os.path.splitext(output)[0]
	name = f"{time.strftime('%Y%m%d-%H%M%S')}-{secrets.token_hex(2)}"
	folder = f"{stem}.strips/{name}"
	try:
		os.makedirs(os.path.dirname(folder), exist_ok=True)
		os.mkdir(folder)
		os.mkdir(f"{folder}/parts")
		os.mkdir(f"{folder}/log")
	except OSError as error:
		raise file_error(folder, error) from None
	write_json(f"{folder}/submission.json", {**values, "id": secrets.token_hex(8), "output": output})
	return folder


def load(folder):
	values = read_json(f"{folder}/submission.json")
	if values is None:
		raise Failure(3, f"{folder}: no submission of povray-strips (there is no submission.json)")
	if "words" not in values:
		raise refused(f"{folder}: a submission of an earlier povray-strips; submit the scene again")
	values["folder"] = os.path.abspath(folder)
	return values


def load_cut(sub):
	cut = read_json(f"{sub['folder']}/cut.json")
	if cut is not None and cut["id"] != sub["id"]:
		raise refused(f"{sub['folder']}/cut.json belongs to another submission")
	return cut


def part_file(sub, unit):
	return f"{sub['folder']}/parts/{unit:05d}{sub['suffix']}"


def record_file(sub, unit):
	return f"{sub['folder']}/parts/{unit:05d}.json"


def is_done(sub, cut, unit, thorough=False):
	"""Whether the part is there, of this submission and of these rows; `thorough`: and its bytes are those that were written."""
	record = read_json(record_file(sub, unit))
	if record is None or record.get("id") != sub["id"] or [record[k] for k in ("frame", "first", "last")] != \
			[cut["units"][unit][k] for k in ("frame", "first", "last")]:
		return False
	path = part_file(sub, unit)
	try:
		return os.path.getsize(path) == record["bytes"] and (not thorough or digest(path) == record["sha256"])
	except OSError:
		return False


def missing_units(sub, cut, thorough=False):
	return [unit for unit in range(len(cut["units"])) if not is_done(sub, cut, unit, thorough)]


def describe(unit):
	frame = "" if unit["frame"] is None else f"frame {unit['frame']}, "
	return f"{frame}rows {unit['first']} to {unit['last']}"


def stamp(path):
	"""By which a file is known again; None where there is none."""
	try:
		state = os.stat(path)
	except OSError:
		return None
	return [state.st_mtime_ns, state.st_size, state.st_ino]
