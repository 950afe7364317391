//! Bands and lines of equal value of a function given on a grid, in the unit square.

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
        let (i, j) = ((u as usize).min(columns - 2), (v as usize).min(rows - 2));
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

/// Pieces of the line on which the values are `level`, by linear interpolation along the sides of the grid.
pub(super) fn isoline(values: &[f64], columns: usize, rows: usize, level: f64) -> Vec<[[f64; 2]; 2]> {
    let mut pieces = Vec::new();
    let at = |i: usize, j: usize| values[i + columns * j] - level;
    let scaled = |i: f64, j: f64| [i / (columns - 1) as f64, j / (rows - 1) as f64];
    for j in 0..rows - 1 {
        for i in 0..columns - 1 {
            // Two triangles each cell: in a triangle a line enters and leaves once.
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
