// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef PICTURE_ROWS_ROWS_FILE_H
#define PICTURE_ROWS_ROWS_FILE_H

#include <stdexcept>
#include <string>
#include <vector>

namespace picture_rows
{

struct Failure : std::runtime_error
{
	Failure(int exit_code, const std::string& text) : std::runtime_error(text), code(exit_code) {}
	int code;
};

/// Rows of a picture, 0 at the top.
struct Piece
{
	std::string file;
	int first, rows;
};

/// By the first bytes; what is neither PNG nor OpenEXR is refused. Throws Failure, as all here do.
bool IsPng(const std::string& file);

int HeightOf(const std::string& file);
int PngHeight(const std::string& file);
int ExrHeight(const std::string& file);

/// One picture of all pieces, below each other, into `temporary`; `file` is its name in messages. Row by row, so that
/// a large picture takes no memory. All pieces are of one format, width and kind of pixels.
void WritePng(const std::vector<Piece>& pieces, const std::string& temporary, const std::string& file);
void WriteExr(const std::vector<Piece>& pieces, const std::string& temporary, const std::string& file);

}

#endif
