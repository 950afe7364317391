//! Coefficients of a motion on its torus, from a grid of flows.

use super::flow::Axes;
use super::found::Torus;
use super::fourier::{Pair, QuarterGrid, Reflection};
use crate::error::Error;

/// Coefficients below this are rounding.
pub(super) const ROUNDING: f64 = 2e-16;

/// Points of the first angle and of a quarter turn of the second one: of the first grid, and at most.
const FIRST_GRID: QuarterGrid = QuarterGrid { points: 16, quarter: 4 };
const LARGEST_GRID: QuarterGrid = QuarterGrid { points: 192, quarter: 256 };

/// Coefficients of a function, by multiples of the first angle and then of the second.
pub(super) type Coefficients = Vec<Vec<Pair>>;

/// What a reflection and half a turn of the second angle do to the twelve functions.
const SYMMETRY: [(Reflection, usize); 12] = {
    use Reflection::{Even, Odd};
    let of_n_and_l = [(Even, 1), (Even, 1), (Odd, 1), (Odd, 1), (Even, 0), (Even, 0)];
    let [a, b, c, d, e, _] = of_n_and_l;
    [a, b, c, d, e, e, a, b, c, d, e, (Odd, 0)]
};

/// Coefficients of `n_X, L_X, n_Y, L_Y, n_Z, L_Z`, with `L` in units of its length, and of `Re V_X, Im V_Y, Re V_Y, Im V_X, Re V_Z, Im V_Z`, where
/// `V = (u + i n x u) exp i (theta_1 psi_1 + theta_2 psi_2) / (2 pi)`, on a grid so fine that the last ones are below the tolerance. `starts` has the
/// states at the points of the second angle; None where it has none.
///
/// # Errors
/// [`Error::NotConverged`] where that takes more points than it may.
pub(super) fn coefficients(
    torus: &Torus,
    starts: impl Fn(usize) -> Option<Vec<Axes<f64>>>,
    tolerance: f64,
) -> Result<Option<[[Coefficients; 6]; 2]>, Error> {
    let mut grid = FIRST_GRID;
    while grid.points <= LARGEST_GRID.points && grid.quarter <= LARGEST_GRID.quarter {
        let Some(starts) = starts(grid.quarter) else { return Ok(None) };
        let functions = sampled(torus, &starts, &grid);
        match finer(&functions, &grid, (0.1 * tolerance).max(ROUNDING)) {
            Some(next) => grid = next,
            None => {
                let mut all = functions.into_iter();
                let mut six = || core::array::from_fn(|_| all.next().unwrap_or_default());
                return Ok(Some([six(), six()]));
            }
        }
    }
    let what = "Fourier series on the torus: this is near the separatrix";
    Err(Error::NotConverged { what, iterations: grid.quarter, residual: tolerance })
}

fn sampled(torus: &Torus, starts: &[Axes<f64>], grid: &QuarterGrid) -> Vec<Coefficients> {
    let QuarterGrid { points, quarter } = *grid;
    let (integrals, ways, size) = (&torus.integrals, &torus.ways, torus.size());
    let mut values = vec![vec![vec![0.0; points]; quarter + 1]; SYMMETRY.len()];
    let round = ways.fast.times.map(|time| 2.0 * time);
    for (m, start) in starts.iter().enumerate() {
        let mut begin = 0.0;
        let mut series = integrals.series(round, start);
        for j in 0..points {
            let part = j as f64 / points as f64;
            while part - begin > series.step {
                let at = series.at(series.step);
                begin += series.step;
                series = integrals.series(round, &at);
            }
            let [n, momentum, u] = series.at(part - begin);
            let turned = 2.0 * ways.fast.turn * part + ways.slow.turn * m as f64 / (2 * quarter) as f64;
            let (sin, cos) = turned.sin_cos();
            let v = n.cross(&u);
            let (l, real, imaginary) = (momentum / size, u * cos - v * sin, v * cos + u * sin);
            let all = [n.x, l.x, n.y, l.y, n.z, l.z, real.x, imaginary.y, real.y, imaginary.x, real.z, imaginary.z];
            for (values, value) in values.iter_mut().zip(all) {
                values[m][j] = value;
            }
        }
    }
    let functions = values.iter().zip(SYMMETRY);
    functions.map(|(values, (reflection, parity))| grid.coefficients(values, reflection, parity)).collect()
}

/// A finer grid, where the last coefficients along an angle are above the smallest wanted.
fn finer(functions: &[Coefficients], grid: &QuarterGrid, smallest: f64) -> Option<QuarterGrid> {
    let QuarterGrid { points, quarter } = *grid;
    let mut along_first = vec![0.0_f64; points / 2];
    let mut along_second = vec![0.0_f64; 2 * quarter + 2];
    for (table, (_, parity)) in functions.iter().zip(SYMMETRY) {
        for (j, row) in table.iter().enumerate() {
            for (i, [a, b]) in row.iter().enumerate() {
                let (size, k) = (a.abs().max(b.abs()), 2 * i + parity);
                along_first[j] = along_first[j].max(size);
                along_second[k] = along_second[k].max(size);
            }
        }
    }
    let [first, second] = [&along_first, &along_second].map(|sizes| needed(sizes, smallest));
    let next = QuarterGrid {
        points: if first > along_first.len() { (2 * first).next_multiple_of(8) } else { points },
        quarter: if second > along_second.len() { second.div_ceil(2).next_multiple_of(2) } else { quarter },
    };
    (next.points > points || next.quarter > quarter).then_some(next)
}

/// How many coefficients there must be until they are below the smallest wanted: they fall as a power of their multiple, as the last half of them says.
fn needed(sizes: &[f64], smallest: f64) -> usize {
    let count = sizes.len();
    let largest_from = |from: usize| sizes[from..].iter().copied().fold(0.0, f64::max);
    let last = largest_from(count - 2);
    if last <= smallest {
        return count;
    }
    let fall = (largest_from(count / 2) / last).ln() / (count - 2 - count / 2) as f64;
    let more = ((last / smallest).ln() / fall).max(1.0);
    count + if more < count as f64 { more.ceil() as usize + 1 } else { count }
}
