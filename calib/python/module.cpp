// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The library (calib/include/tiltcal) as a Python module. Arrays are numpy's, float64; a function of points takes any shape whose last
// axis is a point's, and gives the same shape.

#include <tiltcal/calibrate.h>
#include <tiltcal/camera.h>
#include <tiltcal/error.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace py = pybind11;
using namespace tiltcal;

namespace
{

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

const double NONE = std::numeric_limits<double>::quiet_NaN();

template<size_t N>
Array ArrayOf(const std::array<double, N>& values)
{
	Array out(static_cast<py::ssize_t>(N));
	std::copy(values.begin(), values.end(), out.mutable_data());
	return out;
}

Array ArrayOf(const Vec3<double>& v) { return ArrayOf(std::array<double, 3>{ v.x, v.y, v.z }); }

/// Calls `of` with every point of `in`, whose last axis has `width` numbers, and a place for its result. `tail`: the result's own axes.
template<typename Of>
Array ForPoints(const Array& in, py::ssize_t width, const std::vector<py::ssize_t>& tail, Of of)
{
	if (in.ndim() < 1 || in.shape(in.ndim() - 1) != width)
		throw UsageError("the last axis must have " + std::to_string(width) + " numbers");
	std::vector<py::ssize_t> shape(in.shape(), in.shape() + in.ndim() - 1);
	py::ssize_t step = 1;
	for (const py::ssize_t n : tail)
	{
		shape.push_back(n);
		step *= n;
	}
	Array out(shape);
	const double* from = in.data();
	double* to = out.mutable_data();
	const py::ssize_t count = in.size() / width;
	const py::gil_scoped_release unlocked;
	for (py::ssize_t i = 0; i < count; ++i)
		of(from + i * width, to + i * step);
	return out;
}

Vec3<double> PointAt(const double* p) { return { p[0], p[1], p[2] }; }

Array ProjectAll(const StateCamera& c, const Array& points)
{
	return ForPoints(points, 3, { 2 }, [&](const double* p, double* out)
	{
		const Point pixel = Project(c, PointAt(p)).value_or(Point{ NONE, NONE });
		out[0] = pixel[0];
		out[1] = pixel[1];
	});
}

Array UnprojectAll(const StateCamera& c, const Array& pixels)
{
	return ForPoints(pixels, 2, { 3 }, [&](const double* p, double* out)
	{
		const Vec3<double> v = Unproject(c, { p[0], p[1] }).value_or(Vec3<double>{ NONE, NONE, NONE });
		const double length = std::sqrt(Dot(v, v));
		out[0] = v.x / length;
		out[1] = v.y / length;
		out[2] = v.z / length;
	});
}

Array BlurAll(const StateCamera& c, const Array& points)
{
	return ForPoints(points, 3, {}, [&](const double* p, double* out) { *out = Project(c, PointAt(p)) ? BlurWidth(c, PointAt(p)) : NONE; });
}

Array FootprintAll(const StateCamera& c, const Array& points, py::ssize_t count)
{
	if (count < 1)
		throw UsageError("`count` must be at least 1");
	return ForPoints(points, 3, { count, 2 }, [&](const double* p, double* out)
	{
		const auto outline = Footprint(c, PointAt(p), static_cast<size_t>(count));
		for (py::ssize_t i = 0; i < count; ++i)
			for (size_t k = 0; k < 2; ++k)
				*out++ = outline ? (*outline)[static_cast<size_t>(i)][k] : NONE;
	});
}

std::optional<Model> ParseModel(const std::string& text)
{
	if (text == "auto")
		return std::nullopt;
	for (const Model model : { Model::PAPER, Model::RIGID, Model::PLANE, Model::CURVED, Model::LENS })
		if (text == NameOf(model))
			return model;
	throw UsageError("`model` '" + text + "': there is auto, paper, rigid, plane, curved, lens");
}

Poses ParsePoses(const std::string& text)
{
	for (const auto& [name, poses] : { std::pair{ "auto", Poses::AUTO }, { "shared", Poses::SHARED }, { "own", Poses::OWN } })
		if (text == name)
			return poses;
	throw UsageError("`poses` '" + text + "': there is auto, shared, own");
}

/// Of a message: a file's name in it may be in another encoding.
py::str Text(const std::string& message)
{
	PyObject* text = PyUnicode_DecodeUTF8(message.data(), static_cast<py::ssize_t>(message.size()), "backslashreplace");
	if (!text)
		throw py::error_already_set();
	return py::reinterpret_steal<py::str>(text);
}

/// `progress` hears every message; Ctrl-C stops at the next one.
Log LogTo(const py::object& progress)
{
	return Log([progress](Severity, const std::string& message)
	{
		const py::gil_scoped_acquire locked;
		if (PyErr_CheckSignals() != 0)
			throw py::error_already_set();
		if (!progress.is_none())
			progress(Text(message));
	});
}

using Photographs = std::map<std::string, std::vector<std::filesystem::path>>;
/// State, f-number, files.
using AtStop = std::tuple<std::string, double, std::vector<std::filesystem::path>>;

Calibration CalibrateFiles(const std::vector<std::filesystem::path>& untilted, const Photographs& tilted, const std::string& board, double square_mm, double pitch_mm,
	const std::string& target, double circle_diameter_mm, const std::string& model, const std::string& poses, const std::string& transfer, int edges_per_photo,
	int threads, const std::optional<double>& f_number, const std::vector<AtStop>& stopped, bool any_orientation, const py::object& progress)
{
	const auto names = [](const std::vector<std::filesystem::path>& files) { return std::vector<std::string>(files.begin(), files.end()); };
	std::vector<StateFiles> states{ { "untilted", names(untilted), f_number } };
	for (const auto& [name, files] : tilted)
		states.push_back({ name, names(files), f_number });
	for (const auto& [name, number, files] : stopped)
		states.push_back({ name, names(files), number });
	for (const StateFiles& state : states)
		if (state.files.empty())
			throw UsageError("state " + state.name + " has no photographs");
	const Board target_board = MakeBoard(ParseTargetKind(target), board, square_mm, circle_diameter_mm);
	MeasureOptions measure;
	measure.transfer = ParseTransfer(transfer);
	measure.edges_per_photo = edges_per_photo;
	measure.threads = threads;
	measure.any_orientation = any_orientation;
	measure.log = LogTo(progress);
	CalibrateOptions solve;
	solve.model = ParseModel(model);
	solve.scene_lens = edges_per_photo == 0;
	solve.poses = ParsePoses(poses);
	solve.threads = threads;
	solve.log = measure.log;
	const py::gil_scoped_release unlocked;
	return Calibrate(MeasureAll(states, target_board, pitch_mm, measure), solve);
}

size_t IndexOf(const Calibration& c, const std::string& state)
{
	for (size_t s = 0; s < c.task.states.size(); ++s)
		if (c.task.states[s].name == state || state.empty())
			return s;
	throw UsageError("there is no state " + state);
}

std::vector<std::string> Names(const Calibration& c)
{
	std::vector<std::string> names;
	for (const State& state : c.task.states)
		names.push_back(state.name);
	return names;
}

void AddCamera(py::module_& m)
{
	py::class_<StateCamera>(m, "Camera", "The camera of one state of the lens. Frame: origin in the lens centre, x right, y up, z forward, mm, on a sensor that\n"
		"stays put when the lens tilts. Pixels: (0, 0) is the centre of the top left one, v down.")
		.def_readonly("state", &StateCamera::state).def_readonly("model", &StateCamera::model)
		.def_readonly("width", &StateCamera::width, "px").def_readonly("height", &StateCamera::height, "px")
		.def_readonly("pitch_mm", &StateCamera::pitch_mm, "distance of the sensor's pixels")
		.def_readonly("image_distance_mm", &StateCamera::image_distance_mm, "w, from the lens to the sensor")
		.def_readonly("aperture_diameter_mm", &StateCamera::aperture_diameter_mm, "d; 0: unknown")
		.def_readonly("focus_distance_mm", &StateCamera::focus_distance_mm, "U; inf: that; < 0: beyond infinity; means nothing where the aperture is unknown")
		.def_readonly("field_curvature_per_mm", &StateCamera::field_curvature_per_mm)
		.def_readonly("lens_tilt_deg", &StateCamera::lens_tilt_deg).def_readonly("tilt_direction_deg", &StateCamera::tilt_direction_deg)
		.def_property_readonly("principal_point", [](const StateCamera& c) { return ArrayOf(c.principal_point); }, "(2,), px")
		.def_property_readonly("distortion", [](const StateCamera& c) { return ArrayOf(c.distortion); }, "(5,): k1, k2, p1, p2, k3, about the lens axis")
		.def_property_readonly("lens_normal", [](const StateCamera& c) { return ArrayOf(c.LensNormal()); }, "(3,), unit")
		.def_property_readonly("plane_of_focus", [](const StateCamera& c) { return ArrayOf(c.PlaneOfFocus()); }, "(3,), 1/mm: q, in focus is where q.P = 1")
		.def("project", &ProjectAll, py::arg("points"), "points (..., 3), mm -> pixels (..., 2). NaN: not in front of the lens, or beyond what its distortion is known for.")
		.def("unproject", &UnprojectAll, py::arg("pixels"), "pixels (..., 2) -> unit directions (..., 3) of what they see through the lens centre; NaN where the distortion has no inverse.")
		.def("blur", &BlurAll, py::arg("points"), "points (..., 3), mm -> diameters of their blur discs (...), px, to first order. NaN: not seen, or the aperture is unknown (an imported camera's).")
		.def("footprint", &FootprintAll, py::arg("points"), py::arg("count") = 64, "points (..., 3), mm -> outlines of their blur discs (..., count, 2), px; NaN as of blur.")
		.def("povray", [](const StateCamera& c, double unit_mm) { return CameraBlockOf(c, {}, unit_mm); }, py::arg("unit_mm") = 1.0,
			"The camera { tilt_lens { ... } } block for the patched POV-Ray, at the origin; the scene declares TiltCal_Blur_Samples, and TiltCal_Denoise = 1 where it wants denoise.")
		.def("__repr__", [](const StateCamera& c) { return "<tiltcal.Camera " + c.state + ", tilt " + std::to_string(c.lens_tilt_deg) + " degrees>"; });
	m.def("read_camera", [](const std::filesystem::path& file, const std::string& state) { return ReadStateCamera(file.string(), state); }, py::arg("file"),
		py::arg("state") = "", "The camera of a state of calibration.json (tiltcal calibrate, import); '': the first, which is the untilted one.");
}

void AddCalibration(py::module_& m)
{
	py::class_<Calibration>(m, "Calibration")
		.def_property_readonly("states", &Names, "names; the first is the untilted one")
		.def_property_readonly("model", [](const Calibration& c) { return NameOf(c.Answer()); })
		.def_property_readonly("grade", [](const Calibration& c) { return c.IsJudged() ? std::optional<std::string>(NameOf(c.verdict.grade)) : std::nullopt; }, "good, fair or poor; None of the paper's method, which is not judged")
		.def_property_readonly("remarks", [](const Calibration& c)
		{
			py::list texts;
			for (const Remark& remark : c.verdict.remarks)
				texts.append(Text(remark.text));
			return texts;
		}, "what speaks against it, and what to photograph")
		.def("tilt", [](const Calibration& c, const std::string& state)
		{
			const Estimate tilt = c.TiltOf(IndexOf(c, state)).lens_tilt;
			return std::pair(tilt.value, tilt.sigma);
		}, py::arg("state"), "(tilt, its standard deviation), degrees; of the real lens where that is the answer")
		.def("camera", [](const Calibration& c, const std::string& state, bool distorted)
		{
			return CameraOfState(c, IndexOf(c, state), distorted ? Distorted::YES : Distorted::NO);
		}, py::arg("state") = "", py::arg("distorted") = true, "distorted=False: the best camera without distortion");
	m.def("calibrate", &CalibrateFiles, py::arg("untilted"), py::arg("tilted"), py::kw_only(), py::arg("board"), py::arg("square_mm"), py::arg("pitch_mm"),
		py::arg("target") = "checkerboard", py::arg("circle_diameter_mm") = 0.0, py::arg("model") = "auto", py::arg("poses") = "auto", py::arg("transfer") = "srgb",
		py::arg("edges_per_photo") = 0, py::arg("threads") = 0, py::arg("f_number") = py::none(), py::arg("stopped") = std::vector<AtStop>(), py::arg("any_orientation") = false, py::arg("progress") = py::none(),
		"untilted: files; tilted: {state: files}; board: '12x9' squares or circles of square_mm; pitch_mm: distance of the sensor's pixels.\n"
		"stopped: [(state, f_number, files)], photographs of these states at other f-numbers; f_number: of untilted and tilted, else EXIF's.\n"
		"The other words are those of `tiltcal calibrate --help`; fix, prior, effects, flat_field and refine are the program's alone. progress: called with every message. Raises tiltcal.Error, which names the\n"
		"photograph or argument at fault.");
}

}

PYBIND11_MODULE(tiltcal, m)
{
	m.doc() = "Calibrates a tilted lens from photographs of a board, and sees through it.";
	m.attr("__version__") = TILTCAL_VERSION;
	static py::exception<Error> error(m, "Error", PyExc_ValueError);
	py::register_exception_translator([](std::exception_ptr thrown)
	{
		try
		{
			std::rethrow_exception(thrown);
		}
		catch (const Error& e)
		{
			PyErr_SetObject(error.ptr(), Text(e.what()).ptr());
		}
	});
	AddCamera(m);
	AddCalibration(m);
}
