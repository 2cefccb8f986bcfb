"""Reads the numbers on the contours of a `show focus` picture, by their looks, and compares them with the scene's closed form.

    read_labels.py PICTURE.ppm PIXELS_PER_COLUMN MIDDLE LEAST [nearer-right|nearer-left]

The scene's blur is PIXELS_PER_COLUMN times the column's distance from MIDDLE, the same in all rows. Each number must stand on its
contour: within half a pixel, for the rounding of its place. At least LEAST numbers. Prints them."""
import re
import sys

SHAPES = {  # as a person sees them
    "0": "###/#.#/#.#/#.#/###", "1": ".#./##./.#./.#./###", "2": "###/..#/###/#../###", "3": "###/..#/###/..#/###",
    "4": "#.#/#.#/###/..#/..#", "5": "###/#../###/..#/###", "6": "###/#../###/#.#/###", "7": "###/..#/..#/.#./.#.",
    "8": "###/#.#/###/#.#/###", "9": "###/#.#/###/..#/###"}
DIGITS = {shape: digit for digit, shape in SHAPES.items()}


def picture(name):
    data = open(name, "rb").read()
    header = re.match(rb"P6\s+(?:#.*\n)*(\d+)\s+(\d+)\s+(\d+)\s", data)
    width, height, most = map(int, header.groups())
    size = 2 if most > 255 else 1
    at = header.end()
    numbers = [int.from_bytes(data[i:i + size], "big") / most for i in range(at, at + 3 * size * width * height, size)]
    return width, height, [tuple(numbers[3 * i:3 * i + 3]) for i in range(width * height)]


def main():
    name, slope, middle, least = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
    width, height, pixels = picture(name)
    def kind(x, y):
        if not (0 <= x < width and 0 <= y < height):
            return " "
        r, g, b = pixels[y * width + x]
        near = lambda want: all(abs(have - w) < 1e-3 for have, w in zip((r, g, b), want))
        if near((1, 1, 1)):
            return "#"
        return "n" if near((0.045, 0.1575, 0.45)) else "f" if near((0.45, 0.1575, 0.0135)) else " "
    kinds = [[kind(x, y) for x in range(width)] for y in range(height)]
    faults, found, done = [], [], set()
    for y in range(height):
        for x in range(width):
            if kinds[y][x] == " " or (x, y) in done:
                continue
            right = x
            while right < width and kinds[y][right] != " ":
                right += 1
            bottom = y
            while bottom < height and kinds[bottom][x] != " ":
                bottom += 1
            done.update((i, j) for i in range(x, right) for j in range(y, bottom))
            if (right - x - 1) % 4 or bottom - y != 7 or any(kinds[j][i] == " " for i in range(x, right) for j in range(y, bottom)):
                faults.append(f"no whole plate at {x}, {y}: {right - x} x {bottom - y}")
                continue
            text = ""
            for i in range(x + 1, right, 4):
                shape = "/".join("".join("#" if kinds[j][i + k] == "#" else "." for k in range(3)) for j in range(y + 1, y + 6))
                text += DIGITS.get(shape, "?")
            sign = 1 if kinds[y][x] == "n" else -1
            centre = (x + right - 1) / 2
            found.append((sign, text))
            if not text.isdigit() or abs((centre - middle) * slope - sign * int(text)) > 0.501 * abs(slope):
                faults.append(f"{text} stands at {centre}, {y}, where the blur is {(centre - middle) * slope:.2f}")
    if len(found) < least:
        faults.append(f"only {len(found)} numbers, not {least}")
    print("\n".join(faults) or "numbers: " + ", ".join(("" if s > 0 else "-") + t for s, t in sorted(set(found))))
    return bool(faults)


sys.exit(main())
