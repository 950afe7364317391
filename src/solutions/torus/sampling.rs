//! Coefficients of a motion on its torus, from a grid of flows.

use super::flow::{Axes, apart};
use super::fourier::{Pair, QuarterGrid, Reflection};
use super::torus_of_motion::Torus;
use crate::error::Error;

/// Coefficients below this are rounding.
pub(super) const ROUNDING: f64 = 2e-16;

/// Largest allowed rounding of a coefficient: flows near the separatrix amplify theirs.
const LARGEST_ROUNDING: f64 = 1e-12;

/// Numbers of points of the first grid: for the first angle, and for a quarter turn of the second one. The largest allowed numbers follow, also
/// for both together.
pub(super) const FIRST_GRID: QuarterGrid = QuarterGrid { points: 16, quarter: 4 };
const LARGEST_GRID: QuarterGrid = QuarterGrid { points: 1024, quarter: 512 };
const MOST_POINTS: usize = 1 << 17;

/// Coefficients of a function, by multiples of the first angle and then of the second.
pub(super) type Coefficients = Vec<Vec<Pair>>;

/// Coefficients of the motion on a torus.
pub(super) struct Sampled {
    pub(super) grid: QuarterGrid,
    /// Coefficients of `n_X, L_X, n_Y, L_Y, n_Z, L_Z`, with `L` in its unit.
    pub(super) axes: [Coefficients; 6],
    /// Coefficients of `Re V_X, Im V_Y, Re V_Y, Im V_X, Re V_Z, Im V_Z`, where
    /// `V = (u + i n x u) exp i (theta_1 psi_1 + theta_2 psi_2) / (2 pi)`.
    pub(super) vector: [Coefficients; 6],
    /// Rounding of the states from which the coefficients are computed.
    pub(super) open: f64,
    /// States between the points of the grid, half-way in both angles: they reveal aliasing of the coefficients by the grid.
    pub(super) between: [OnTorus; 4],
}

/// A state on a torus, and the turns of its angles.
pub(super) struct OnTorus {
    pub(super) turns: [f64; 2],
    pub(super) axes: Axes<f64>,
}

/// The effect of a reflection and of half a turn of the second angle on the twelve functions.
const SYMMETRY: [(Reflection, usize); 12] = {
    use Reflection::{Even, Odd};
    let of_n_and_l = [(Even, 1), (Even, 1), (Odd, 1), (Odd, 1), (Even, 0), (Even, 0)];
    let [a, b, c, d, e, _] = of_n_and_l;
    [a, b, c, d, e, e, a, b, c, d, e, (Odd, 0)]
};

/// Coefficients on a grid at least as fine as the coarsest allowed, and so fine that the last coefficients are below the tolerance. `starts` gives
/// the states at the points of the second angle, or `None`.
///
/// # Errors
/// [`Error::NotConverged`] if this takes more points than allowed.
pub(super) fn coefficients(
    torus: &Torus,
    starts: impl Fn(usize) -> Option<Vec<Axes<f64>>>,
    tolerance: f64,
    coarsest: QuarterGrid,
) -> Result<Option<Sampled>, Error> {
    let mut grid = coarsest;
    let fits = |grid: &QuarterGrid| {
        grid.points <= LARGEST_GRID.points
            && grid.quarter <= LARGEST_GRID.quarter
            && grid.points * grid.quarter <= MOST_POINTS
    };
    while fits(&grid) {
        let Some(starts) = starts(grid.quarter) else { return Ok(None) };
        let (functions, open) = sampled(torus, &starts, &grid);
        match finer(&functions, &grid, (0.1 * tolerance).max(ROUNDING)) {
            Some(next) => grid = next,
            None => {
                let mut all = functions.into_iter();
                let mut six = || core::array::from_fn(|_| all.next().unwrap_or_default());
                let between = [1, 3, 5, 7].map(|eighth| between(torus, &starts, &grid, eighth));
                return Ok(Some(Sampled { grid, axes: six(), vector: six(), open, between }));
            }
        }
    }
    let what = "Fourier series on the torus near the separatrix";
    Err(Error::NotConverged { what, iterations: grid.quarter, residual: tolerance })
}

/// Coefficients of the functions from their values on a grid; and the largest difference of both ends of a row, which are the same point of the
/// torus.
fn sampled(torus: &Torus, starts: &[Axes<f64>], grid: &QuarterGrid) -> (Vec<Coefficients>, f64) {
    let QuarterGrid { points, quarter } = *grid;
    let (orbits, unit) = (&torus.orbits, torus.unit);
    let mut values = vec![vec![vec![0.0; points]; quarter + 1]; SYMMETRY.len()];
    let mut open: f64 = 0.0;
    for (m, start) in starts.iter().enumerate() {
        // Half a turn in either direction from the start of a row, because rounding grows along the flow.
        let [(forwards, end), (backwards, other)] = [1.0, -1.0].map(|sense| half_row(torus, start, points, sense));
        open = open.max(apart(&end, &other, unit));
        let places = (0..points / 2).chain((points / 2..points).rev());
        for (j, [n, momentum, u]) in places.zip(forwards.into_iter().chain(backwards)) {
            let part = if j < points / 2 { j as f64 } else { j as f64 - points as f64 } / points as f64;
            let (sin, cos) = orbits.turned([part, m as f64 / (4 * quarter) as f64]).sin_cos();
            let v = n.cross(&u);
            let (l, real, imaginary) = (momentum / unit, u * cos - v * sin, v * cos + u * sin);
            let all = [n.x, l.x, n.y, l.y, n.z, l.z, real.x, imaginary.y, real.y, imaginary.x, real.z, imaginary.z];
            for (values, value) in values.iter_mut().zip(all) {
                values[m][j] = value;
            }
        }
    }
    let functions = values.iter().zip(SYMMETRY);
    (functions.map(|(values, (reflection, parity))| grid.coefficients(values, reflection, parity)).collect(), open)
}

/// The state half-way between points of the grid: `eighth` eighths of a quarter turn of the second angle onwards, and as many eighths of a turn of
/// the first angle, counted from minus half a turn.
fn between(torus: &Torus, starts: &[Axes<f64>], grid: &QuarterGrid, eighth: usize) -> OnTorus {
    let [i, m] = [eighth * grid.points / 8, eighth * grid.quarter / 8];
    let half = 0.5 / (4 * grid.quarter) as f64;
    let turns = [(i as f64 + 0.5) / grid.points as f64 - 0.5, m as f64 / (4 * grid.quarter) as f64 + half];
    // From the start of the previous row, since the flow from the plane has more rounding.
    let times = [0, 1].map(|i| 2.0 * (torus.orbits.fast.times[i] * turns[0] + torus.orbits.slow.times[i] * half));
    OnTorus { turns, axes: torus.integrals.moved(times, &starts[m]) }
}

/// States up to half a turn of the first angle from a given one: forwards including the given state, backwards without it; and the state at half a
/// turn.
fn half_row(torus: &Torus, start: &Axes<f64>, points: usize, sense: f64) -> (Vec<Axes<f64>>, Axes<f64>) {
    let round = torus.orbits.fast.times.map(|time| 2.0 * sense * time);
    let mut begin = 0.0;
    let mut series = torus.integrals.series(round, start);
    let mut at = |part: f64| {
        while part - begin > series.step {
            let next = series.at(series.step);
            begin += series.step;
            series = torus.integrals.series(round, &next);
        }
        series.at(part - begin)
    };
    let first = usize::from(sense < 0.0);
    let states = (first..points / 2 + first).map(|j| at(j as f64 / points as f64)).collect();
    (states, at(0.5))
}

/// A finer grid, if the last coefficients along an angle are above the smallest one required.
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

/// Number of coefficients needed until they are below the smallest one required. They are taken to fall as a power of their multiple, which is
/// estimated from their last half.
fn needed(sizes: &[f64], smallest: f64) -> usize {
    let count = sizes.len();
    let largest_from = |from: usize| sizes[from..].iter().copied().fold(0.0, f64::max);
    let last = largest_from(count - 2);
    let falls = largest_from(count / 2) / last;
    // Unless they are rounding, coefficients that have become so small fall by more than 1e5 in their second half.
    if last <= smallest || last < LARGEST_ROUNDING && falls < 30.0 {
        return count;
    }
    let fall = falls.ln() / (count - 2 - count / 2) as f64;
    let more = ((last / smallest).ln() / fall).max(1.0);
    count + if more < count as f64 { more.ceil() as usize + 1 } else { count }
}
