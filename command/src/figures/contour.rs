//! Contour bands and contour lines of a function given on a grid, in the unit square.

/// Interpolated cells between two grid points.
const FINENESS: usize = 6;

/// Rectangles `[left, bottom, right, top]` of the unit square and the band of each, for `values` in rows from the bottom.
pub(super) fn bands(
    values: &[f64],
    columns: usize,
    rows: usize,
    band: impl Fn(f64) -> usize,
) -> Vec<([f64; 4], usize)> {
    let (wide, high) = ((columns - 1) * FINENESS, (rows - 1) * FINENESS);
    let value = |u: f64, v: f64| {
        let (i, j) = (u as usize, v as usize);
        let (p, q) = (u - i as f64, v - j as f64);
        let at = |i: usize, j: usize| values[i + columns * j];
        (at(i, j) * (1.0 - p) + at(i + 1, j) * p) * (1.0 - q) + (at(i, j + 1) * (1.0 - p) + at(i + 1, j + 1) * p) * q
    };
    let mut cells = Vec::new();
    for j in 0..high {
        let bands: Vec<_> = (0..wide)
            .map(|i| band(value((i as f64 + 0.5) / FINENESS as f64, (j as f64 + 0.5) / FINENESS as f64)))
            .collect();
        let mut first = 0;
        for run in bands.chunk_by(|a, b| a == b) {
            let last = first + run.len();
            let place = |i: usize, of: usize| i as f64 / of as f64;
            cells.push(([place(first, wide), place(j, high), place(last, wide), place(j + 1, high)], run[0]));
            first = last;
        }
    }
    cells
}

/// Pieces of the contour line at `level`, by linear interpolation along the sides of the grid.
pub(super) fn isoline(values: &[f64], columns: usize, rows: usize, level: f64) -> Vec<[[f64; 2]; 2]> {
    let mut pieces = Vec::new();
    let at = |i: usize, j: usize| values[i + columns * j] - level;
    let scaled = |i: f64, j: f64| [i / (columns - 1) as f64, j / (rows - 1) as f64];
    for j in 0..rows - 1 {
        for i in 0..columns - 1 {
            // Two triangles per cell: a line enters and leaves each once.
            for corners in [[(i, j), (i + 1, j), (i + 1, j + 1)], [(i, j), (i, j + 1), (i + 1, j + 1)]] {
                let mut ends = Vec::new();
                for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                    let ((ia, ja), (ib, jb)) = (corners[a], corners[b]);
                    let (va, vb) = (at(ia, ja), at(ib, jb));
                    if (va < 0.0) != (vb < 0.0) {
                        let part = va / (va - vb);
                        let mix = |x: usize, y: usize| x as f64 + (y as f64 - x as f64) * part;
                        ends.push(scaled(mix(ia, ib), mix(ja, jb)));
                    }
                }
                if let [a, b] = ends[..] {
                    pieces.push([a, b]);
                }
            }
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values on a grid of four columns and three rows.
    fn sampled(value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        (0..12).map(|k| value(f64::from(k % 4), f64::from(k / 4))).collect()
    }

    /// Interpolation is exact for a product of two linear functions: each rectangle has the band of all its values, and together they cover the
    /// square.
    #[test]
    fn bands_are_those_of_the_function() {
        let value = |x: f64, y: f64| (1.0 + 2.0 * x) * (3.0 - 0.7 * y);
        let band = |value: f64| (value * 1.3) as usize;
        let cells = bands(&sampled(value), 4, 3, band);
        let mut area = 0.0;
        for ([left, bottom, right, top], found) in cells {
            assert!(((top - bottom) * 12.0 - 1.0).abs() < 1e-12 && right > left, "a row of a twelfth of the square");
            let count = ((right - left) * 18.0).round();
            assert!(((right - left) * 18.0 - count).abs() < 1e-12);
            for i in 0..count as usize {
                let x = 3.0 * (left + (i as f64 + 0.5) / 18.0);
                assert_eq!(found, band(value(x, 2.0 * (bottom + 0.5 / 12.0))), "{x} {bottom}");
            }
            area += (right - left) * (top - bottom);
        }
        assert!((area - 1.0).abs() < 1e-12, "{area}");
    }

    /// The pieces of a contour of a linear function lie on it and add up to its length.
    #[test]
    fn a_line_of_equal_value_is_whole() {
        let value = |x: f64, y: f64| 2.0 * x + 3.0 * y;
        // The line from (1, 0) to (0, 2/3) of the grid has the level 2, and so on; ends in grid units.
        for (level, from, to) in [
            (2.0, [1.0, 0.0], [0.0, 2.0 / 3.0]),
            (6.5, [3.0, 0.5 / 3.0], [0.25, 2.0]),
            (4.7, [2.35, 0.0], [0.0, 4.7 / 3.0]),
        ] {
            let pieces = isoline(&sampled(value), 4, 3, level);
            let scaled = |[x, y]: [f64; 2]| [x / 3.0, y / 2.0];
            let distance = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
            for [x, y] in pieces.iter().flatten() {
                assert!((value(3.0 * x, 2.0 * y) - level).abs() < 1e-12, "{x} {y}");
            }
            let length: f64 = pieces.iter().copied().map(distance).sum();
            assert!((length - distance([scaled(from), scaled(to)])).abs() < 1e-12, "{level}: {length}");
        }
    }
}
