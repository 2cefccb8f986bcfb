// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The table. Forgiving in how numbers stand, strict in what they say.

#include "prescription/prescription.h"

#include "base/files.h"
#include "base/numbers.h"
#include "base/plain_text.h"

#include <fmt/format.h>
#include <tiltcal/error.h>

#include <algorithm>
#include <optional>
#include <sstream>

namespace tiltcal
{

namespace
{

const size_t MOST_SURFACES = 200;

enum class Column { NUMBER, RADIUS, DISTANCE, INDEX, ABBE, DIAMETER };

const struct { const char* word; Column column; } COLUMN_WORDS[] =
{
	{ "number", Column::NUMBER }, { "radius", Column::RADIUS }, { "distance", Column::DISTANCE }, { "thickness", Column::DISTANCE },
	{ "index", Column::INDEX }, { "nd", Column::INDEX }, { "abbe", Column::ABBE }, { "vd", Column::ABBE }, { "diameter", Column::DIAMETER }
};

const char* const EXPECTED = "radius, distance, index [, Abbe number] [, clear diameter]";

/// A row as it stands: what is not given stays empty.
struct Row
{
	std::optional<double> radius, distance, index, abbe, diameter;
	bool flat = false, stop = false;
	int line = 0;
};

class Reader
{
public:
	explicit Reader(const std::string& name) : file(name) {}

	Prescription Read(const std::string& text)
	{
		std::istringstream in(WithUnixLines(text));
		std::string words;
		for (line = 1; std::getline(in, words); ++line)
			ReadLine(words);
		return Assemble();
	}

private:
	[[noreturn]] void Fail(const std::string& what, int at) const { throw FileError(fmt::format("{}:{}: {}", file, at, what)); }
	[[noreturn]] void Fail(const std::string& what) const { Fail(what, line); }

	/// The line's words, lower case, without its comment; patents' signs as ours.
	static std::vector<std::string> Words(std::string text)
	{
		for (const auto& [from, to] : { std::pair{ "\u2212", "-" }, std::pair{ "\u221e", "infinity" }, std::pair{ "\u00a0", " " } })
			for (size_t at; (at = text.find(from)) != std::string::npos;)
				text.replace(at, std::string(from).size(), to);
		text = text.substr(0, std::min({ text.find('#'), text.find(';'), text.find("//") }));
		for (char& c : text)
			c = c == ',' || c == '|' || c == '\t' ? ' ' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
		std::istringstream in(text);
		std::vector<std::string> words;
		for (std::string word; in >> word;)
			words.push_back(word);
		return words;
	}

	void ReadLine(const std::string& text)
	{
		const std::vector<std::string> words = Words(text);
		if (words.empty())
			return;
		if (words[0] == "columns" || words[0] == "columns:")
			return ReadColumns({ words.begin() + 1, words.end() });
		for (const std::string& word : words)
			if (word == "asphere" || word == "aspheric" || word == "conic" || word == "k" || word == "a4")
				Fail("aspheric surfaces are not known here; tiltcal traces spheres and planes");
		if (rows.size() == MOST_SURFACES)
			Fail(fmt::format("more than {} surfaces", MOST_SURFACES));
		rows.push_back(ReadRow(words, text));
	}

	void ReadColumns(const std::vector<std::string>& words)
	{
		if (!rows.empty())
			Fail("`columns` belongs before the first surface");
		columns.clear();
		for (const std::string& word : words)
		{
			const auto known = std::find_if(std::begin(COLUMN_WORDS), std::end(COLUMN_WORDS), [&](const auto& w) { return word == w.word; });
			if (known == std::end(COLUMN_WORDS))
				Fail(fmt::format("`{}` is no column; there are number, radius, distance, index, abbe, diameter", OneLine(word.substr(0, 40))));
			if (std::count(columns.begin(), columns.end(), known->column))
				Fail(fmt::format("the column `{}` stands twice", word));
			columns.push_back(known->column);
		}
		for (const Column needed : { Column::RADIUS, Column::DISTANCE, Column::INDEX })
			if (!std::count(columns.begin(), columns.end(), needed))
				Fail("`columns` needs radius, distance and index");
	}

	/// Without a line `columns`: by how many there are. A stop has no glass.
	std::vector<Column> ColumnsOf(size_t count, bool stop, const std::string& text) const
	{
		if (!columns.empty())
		{
			if (count > columns.size())
				Fail(fmt::format("{} values, but `columns` names {}", count, columns.size()));
			return columns;
		}
		if (count < 2 || count > 5)
			Fail(fmt::format("'{}' is no surface: {}; other columns are named by a line such as `columns number radius distance index abbe diameter`",
				OneLine(text.substr(0, 60)), EXPECTED));
		if (stop && count == 3)
			return { Column::RADIUS, Column::DISTANCE, Column::DIAMETER };
		std::vector<Column> usual{ Column::RADIUS, Column::DISTANCE, Column::INDEX, Column::DIAMETER };
		if (count == 5)
			usual.insert(usual.begin() + 3, Column::ABBE);
		return usual;
	}

	Row ReadRow(const std::vector<std::string>& words, const std::string& text) const
	{
		const std::vector<Column> order = ColumnsOf(words.size(), words[0] == "stop", text);
		Row row;
		row.line = line;
		for (size_t k = 0; k < words.size(); ++k)
			ReadField(order[k], words[k], row);
		if (!row.flat && !row.stop && !row.radius)
			Fail("the radius is missing; a flat surface has `infinity`");
		return row;
	}

	void ReadField(Column column, const std::string& word, Row& row) const
	{
		if (column == Column::NUMBER || word == "-" || word == "--")
			return;
		if (column == Column::RADIUS && (word == "stop" || word == "aperture" || word == "diaphragm"))
		{
			row.stop = true;
			return;
		}
		if (column == Column::RADIUS && (word == "infinity" || word == "inf" || word == "flat" || word == "plano" || word == "plane"))
		{
			row.flat = true;
			return;
		}
		if (column == Column::INDEX && word == "air")
		{
			row.index = 1;
			return;
		}
		const std::optional<double> value = FiniteNumber(word);
		const char* const name = std::find_if(std::begin(COLUMN_WORDS), std::end(COLUMN_WORDS), [&](const auto& w) { return w.column == column; })->word;
		if (!value)
			Fail(fmt::format("'{}' is no number, where the {} is expected ({})", OneLine(word.substr(0, 40)), name, EXPECTED));
		Take(column, *value, name, row);
	}

	void Take(Column column, double value, const char* name, Row& row) const
	{
		if (column == Column::RADIUS)
		{
			row.radius = value;
			row.flat = value == 0;      // or the stop: by its index
		}
		else if (value < 0)
			Fail(fmt::format("the {} {:g} is below 0", name, value));
		else if (column == Column::DISTANCE)
			row.distance = value;
		else if (column == Column::ABBE)
			row.abbe = value;
		else if (column == Column::DIAMETER)
			row.diameter = value;
		else if (value < 1 || value > 5)
			Fail(fmt::format("{:g} is no refractive index of a glass (1 to 5)", value));
		else
			row.index = value;
	}

	/// A row of radius 0 or `stop`; a flat row between equal indices without such is none, for a filter has one side in air.
	bool MayBeStop(size_t k) const
	{
		if (rows[k].stop)
			return true;
		return rows[k].radius == 0 && rows[k].index.value_or(1) == (k ? rows[k - 1].index.value_or(1) : 1);
	}

	Prescription Assemble() const
	{
		Prescription lens;
		lens.file = file;
		if (rows.size() < 2)
			Fail(fmt::format("{} surfaces; a lens has two or more, a line each: {}", rows.size(), EXPECTED), line);
		std::optional<size_t> stop;
		for (size_t k = 0; k < rows.size(); ++k)
		{
			if (MayBeStop(k))
			{
				if (stop)
					Fail(fmt::format("a second stop; the first stands in line {}", rows[*stop].line), rows[k].line);
				stop = k;
			}
			lens.surfaces.push_back(SurfaceOf(k, stop == k));
		}
		if (!stop)
			Fail("there is no stop: give its place as a row with the radius 0 (or `stop`) between its two distances", line);
		lens.stop = *stop;
		Check(lens);
		return lens;
	}

	Surface SurfaceOf(size_t k, bool stop) const
	{
		const Row& row = rows[k];
		Surface s;
		s.curvature = stop || row.flat ? 0 : 1 / *row.radius;
		s.index = row.index.value_or(stop && k ? rows[k - 1].index.value_or(1) : 1);
		s.abbe = row.abbe.value_or(0);
		s.clear_radius = row.diameter.value_or(0) / 2;
		if (!row.distance && k + 1 < rows.size())
			Fail("the distance to the next surface is missing", row.line);
		s.distance = row.distance.value_or(0);
		if (row.radius && s.curvature != 0 && s.clear_radius > std::abs(*row.radius))
			Fail(fmt::format("the clear diameter {:g} is wider than the whole sphere of radius {:g}", *row.diameter, *row.radius), row.line);
		return s;
	}

	void Check(const Prescription& lens) const
	{
		const int stop_line = rows[lens.stop].line;
		if (!(lens.StopRadius() > 0))
			Fail("the stop needs its diameter, as the last number of its row", stop_line);
		if (lens.surfaces[lens.stop].index != lens.IndexBefore(lens.stop))
			Fail("the stop stands between two glasses; it has the same index on both sides", stop_line);
		if (lens.surfaces.back().index != 1)
			Fail("behind the last surface there must be air (index 1)", rows.back().line);
	}

	const std::string file;
	int line = 0;
	std::vector<Column> columns;
	std::vector<Row> rows;
};

}

Prescription ParsePrescription(const std::string& text, const std::string& file) { return Reader(file).Read(text); }

Prescription ReadPrescription(const std::string& file)
{
	return ParsePrescription(ReadText(file, "a lens prescription: a line a surface, radius, distance, index, clear diameter", 1 << 20), file);
}

}
