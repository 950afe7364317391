//! The motion as a Fourier series on its torus: any state at any time with the same cost.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use super::double_double_torus::DoubleDoubleTorus;
use super::flow::Axes;
use super::fourier::{QuarterGrid, Reflection};
use super::phase::{Phase, phases};
use super::sampling::{FIRST_GRID, OnTorus, ROUNDING, Sampled, coefficients};
use super::table::{FourMultiples, Multiples, Table};
use super::torus_of_motion::Torus;
use crate::dynamics::{AxisState, BodyState, Problem};
use crate::error::Error;
use crate::numerics::angle::sines_of_turns;
use crate::numerics::arithmetic::plain;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::four_lanes::FourLanes;
use crate::numerics::fused::{Fused, detect_fused, run_fused};

/// Rounding error at the end of half a closed orbit, due to the flow and the initial state.
const END_OF_HALF_PERIOD: f64 = 5e-16;

/// Rounding of the principal values and axes of `s`, in units of its largest component; the difference of nearly equal eigenvalues is not known more
/// precisely.
const ROUNDING_OF_VALUES: f64 = 5e-16;

/// Allowed difference between the series and the flow, in addition to the estimated error, for a torus that has the assumed
/// symmetries.
const CLOSED: f64 = 1e-12;

/// Number of blocks of multiples of the second angle that fit on the stack, for cosines and for sines.
const FEW: usize = 8;

/// The exact motion from an initial state: `n`, `L` and `e_x` as Fourier series of two angles that grow linearly in time, and a third angle that
/// rotates `e_x` about `n`.
///
/// ```text
/// (n, L)(t) = sum_jk (n, L)_jk exp i (j theta_1 + k theta_2),    theta_i = theta_i0 + w_i t
/// ```
///
/// `theta_1` is the rotation of `n` about `L` from the plane of `L` and Z, `theta_2` the rotation of the averaged `L` about Z, the principal axis of
/// `s` that it circles. The coefficients are those of the motion along the commuting flows of `H` and `K` on a grid of the torus. See
/// `docs/exact-motion.md`.
#[derive(Debug, Clone)]
pub struct TorusSolution {
    pub(super) phases: [Phase; 3],
    /// Period vectors: times along the flows of `H` and `K` of both closed orbits. Also the spread that is the unit of `K`.
    pub(super) periods: [[f64; 2]; 2],
    pub(super) spread: f64,
    /// Unit of `L`.
    pub(super) unit: f64,
    /// Width of the torus.
    pub(super) width: f64,
    /// Coefficients of `n` and `L`.
    axes: Table,
    /// Coefficients of `V`, from which `e_x` is obtained by rotation.
    vector: Table,
    /// Number of blocks of four multiples of the second angle that are needed.
    blocks: usize,
    pub(super) given_from_torus: Matrix3<f64>,
    /// Columns of this matrix, each padded with a zero.
    columns: [[f64; 4]; 3],
    truncation: f64,
    /// Difference between the series and the flow, and the rounding of the sum of its terms.
    off: f64,
    /// Error of a state per unit of time, due to the rates.
    drift: f64,
    fused: Option<Fused>,
}

impl TorusSolution {
    /// The motion of a problem, with the error tolerance for the components of `n`, `e_x` and `L`, for times up to `longest` in size. For long times
    /// the closed orbits are computed to 32 digits, which takes a few ms. A tolerance below rounding is taken as rounding.
    ///
    /// # Errors
    /// [`Error::Domain`] for isotropic `s`, a tolerance below zero and a time that is not finite; near the separatrix [`Error::Unsupported`], where the
    /// closed orbits are not found, or [`Error::NotConverged`], where they need more coefficients than a table may have; [`Error::Unsupported`] for a
    /// star with a bulge.
    pub fn new(problem: &Problem<f64>, tolerance: f64, longest: f64) -> Result<Self, Error> {
        problem.require_rigid()?;
        Error::ensure(longest.is_finite(), "longest time", longest, "a finite number")?;
        Error::ensure(tolerance >= 0.0, "tolerance", tolerance, "zero or above")?;
        let tolerance = tolerance.max(ROUNDING);
        let torus = Torus::of(problem)?;
        let given = problem.initial();
        let rate_about_axis = torus.spheroid.rate_about_axis(&given.axis, &given.momentum);
        let near = phases(rate_about_axis, &torus.orbits);
        let torque = 2.0 * torus.spheroid.constant_c.abs() * ROUNDING_OF_VALUES * problem.coefficients().amax();
        // The length of n is rounded, and with it the rate about n.
        let of_length = f64::EPSILON * rate_about_axis.abs();
        let drift = rate_of_orbits(&near) * 2.0 * END_OF_HALF_PERIOD + torque / torus.unit + of_length;
        if longest.abs() * drift <= 0.3 * tolerance
            && let Some(solution) = Self::of(&torus, near, drift, tolerance, |quarter| torus.starts(quarter))?
        {
            return Ok(solution);
        }
        let wide = DoubleDoubleTorus::near(&torus, problem)?;
        let torus = wide.rounded(&torus);
        let starts = |quarter: usize| Some(torus.starts(quarter).unwrap_or_else(|| wide.starts(quarter)));
        let found = Self::of(&torus, wide.phases, wide.drift, tolerance, starts)?;
        found.ok_or(Error::not_found("Fourier series on the torus"))
    }

    /// The series on a torus with these phases, from states at the points of the second angle; `None` if there are none.
    ///
    /// # Errors
    /// [`Error::NotConverged`] if the series does not agree with the motion.
    fn of(
        torus: &Torus,
        phases: [Phase; 3],
        drift: f64,
        tolerance: f64,
        starts: impl Fn(usize) -> Option<Vec<Axes<f64>>>,
    ) -> Result<Option<Self>, Error> {
        let what = "Fourier series on the torus, against its flow";
        let (mut coarsest, mut before) = (FIRST_GRID, [f64::INFINITY; 2]);
        loop {
            let Some(sampled) = coefficients(torus, &starts, tolerance, coarsest)? else { return Ok(None) };
            let (solution, gap) = Self::on(torus, phases, drift, tolerance, &sampled);
            if gap <= 10.0 * solution.truncation + CLOSED {
                return Ok(Some(solution));
            }
            // Coefficients beyond small ones may be larger again, and a grid twice as fine may still alias them; if two refinements in a row do not
            // help, the grid is not the cause.
            if gap.is_nan() || gap > 0.25 * before[0] {
                return Err(Error::NotConverged { what, iterations: sampled.grid.quarter, residual: gap });
            }
            before = [before[1], gap];
            let QuarterGrid { points, quarter } = sampled.grid;
            coarsest = QuarterGrid { points: 2 * points, quarter: 2 * quarter };
        }
    }

    /// The series on a torus with these phases, and its distance from the flow.
    fn on(torus: &Torus, phases: [Phase; 3], drift: f64, tolerance: f64, sampled: &Sampled) -> (Self, f64) {
        let (mut axes, left_axes) = Table::within(&sampled.axes, tolerance);
        let (vector, left_vector) = Table::within(&sampled.vector, tolerance);
        axes.scale_every_other(torus.unit);
        let mut solution = Self {
            width: torus.width(),
            phases,
            periods: [&torus.orbits.fast, &torus.orbits.slow].map(|half| half.times.map(|time| time * 2.0)),
            spread: torus.spread,
            unit: torus.unit,
            blocks: axes.blocks().max(vector.blocks()),
            axes,
            vector,
            given_from_torus: torus.from_given.transpose(),
            columns: [0, 1, 2].map(|i| {
                let row = torus.from_given.row(i);
                [row[0], row[1], row[2], 0.0]
            }),
            truncation: left_axes.max(left_vector),
            off: 0.0,
            drift,
            fused: detect_fused(),
        };
        let gap = solution.gap(torus, &sampled.between);
        let terms = (solution.axes.len() + solution.vector.len()) as f64;
        solution.off = 2.0 * gap.max(sampled.open) + 0.5 * ROUNDING * terms.sqrt();
        (solution, gap)
    }

    /// Largest difference from the start, and from the flow between the points of the grid.
    fn gap(&self, torus: &Torus, between: &[OnTorus]) -> f64 {
        let turn = &torus.from_given;
        let off = |state: &BodyState<f64>, [n, momentum, vector]: &Axes<f64>| {
            let momentum = (turn * state.momentum - momentum) / torus.unit;
            let differences = [turn * state.axis - n, momentum, turn * state.equatorial_axis - vector];
            // NaN counts as a gap.
            differences.iter().flatten().fold(0.0, |most: f64, x| if x.abs() <= most { most } else { x.abs() })
        };
        let gaps = between.iter().map(|OnTorus { turns: [a, b], axes: [n, momentum, u] }| {
            let (sin, cos) = torus.orbits.turned([*a, *b]).sin_cos();
            off(&self.state_on_torus([*a, *b, 0.0]), &[*n, *momentum, u * cos - n.cross(u) * sin])
        });
        let here = off(&self.state([0.0; 2]), &torus.initial);
        gaps.fold(here, |most, x| if x <= most { most } else { x })
    }

    /// Rates of the angles (rad per unit of time): of `n` about `L` from the plane of `L` and Z, of the averaged `L` about Z, and of `e_x` about `n`.
    pub fn rates(&self) -> [f64; 3] {
        self.phases.map(|phase| phase.rate.high * TAU)
    }

    /// Number of pairs of frequencies in the series of `n` and `L`, and in that of `e_x`.
    pub(crate) fn term_counts(&self) -> [usize; 2] {
        [self.axes.len(), self.vector.len()]
    }

    /// Sum of the neglected coefficients: the error of the series, excluding rounding.
    pub(crate) fn truncation(&self) -> f64 {
        self.truncation
    }

    /// Estimated rounding at a time since the start: of the sums, of the coefficients (from the difference between the series and the flow), and of
    /// the rates.
    pub(crate) fn rounding(&self, t: f64) -> f64 {
        8.0 * ROUNDING + self.off + self.drift * t.abs()
    }

    /// Estimated error of the components of `n`, `e_x` and `L` at a time since the start, with `L` in units of its size at the start or of
    /// `(2 I^xx |C| (s_max - s_min))^(1/2)`, which the torque can produce, if that is larger.
    pub fn error_estimate(&self, t: f64) -> f64 {
        self.truncation + self.rounding(t)
    }

    /// `n` and `L` at the time `t[0] + t[1]` since the start.
    pub(crate) fn axis_state(&self, t: [f64; 2]) -> AxisState<f64> {
        match self.fused {
            Some(fused) => run_fused(fused, || self.axis_state_by(fused, t)),
            None => self.axis_state_by(plain(), t),
        }
    }

    /// The state at the time `t[0] + t[1]` since the start.
    pub fn state(&self, t: [f64; 2]) -> BodyState<f64> {
        match self.fused {
            Some(fused) => run_fused(fused, || self.state_by(fused, t)),
            None => self.state_by(plain(), t),
        }
    }

    /// The state at given values of the three angles of the torus, in turns.
    pub fn state_on_torus(&self, turns: [f64; 3]) -> BodyState<f64> {
        match self.fused {
            Some(fused) => run_fused(fused, || self.state_at(fused, turns)),
            None => self.state_at(plain(), turns),
        }
    }

    /// Rates of the three angles in turns per unit of time.
    pub(crate) fn turns_per_time(&self) -> [DoubleDouble; 3] {
        self.phases.map(|phase| phase.rate)
    }

    /// The axis of the second angle.
    pub(crate) fn pole(&self) -> Vector3<f64> {
        self.given_from_torus.column(2).into()
    }

    #[inline(always)]
    fn axis_state_by<F: FourLanes>(&self, four: F, t: [f64; 2]) -> AxisState<f64> {
        let [first, second, _] = &self.phases;
        let turns = [first.at::<F>(t), second.at::<F>(t)];
        let mut room = Room::default();
        let (first, second) = self.multiples(four, turns, &mut room);
        self.axes_at(four, first, &second)
    }

    #[inline(always)]
    fn state_by<F: FourLanes>(&self, four: F, t: [f64; 2]) -> BodyState<f64> {
        let [first, second, third] = &self.phases;
        self.state_at(four, [first.at::<F>(t), second.at::<F>(t), third.at::<F>(t)])
    }

    /// The first multiples of two angles, and all multiples of the second one that are needed, in this buffer.
    #[inline(always)]
    fn multiples<'a, F: FourLanes>(
        &self,
        four: F,
        turns: [f64; 2],
        Room { few, many }: &'a mut Room,
    ) -> (FourMultiples<F>, Multiples<'a>) {
        let [first, second] = sines_of_turns(four, turns);
        let (first, second) = (FourMultiples::first(four, first), FourMultiples::first(four, second));
        let needed = 2 * self.blocks;
        let blocks = if needed <= FEW {
            &mut few[..needed]
        } else {
            many.resize(needed, [0.0; 4]);
            many.as_mut_slice()
        };
        (first, Multiples::fill(four, blocks, second))
    }

    #[inline(always)]
    fn axes_at<F: FourLanes>(&self, four: F, first: FourMultiples<F>, second: &Multiples<'_>) -> AxisState<f64> {
        let [x, lx, y, ly, z, lz] = self.axes.at(four, first, second, Reflection::Even);
        AxisState { axis: self.given(four, [x, y, z]), momentum: self.given(four, [lx, ly, lz]) }
    }

    #[inline(always)]
    fn state_at<F: FourLanes>(&self, four: F, [first, second, third]: [f64; 3]) -> BodyState<f64> {
        let mut room = Room::default();
        let (first, second) = self.multiples(four, [first, second], &mut room);
        let AxisState { axis, momentum } = self.axes_at(four, first, &second);
        let [real_x, imaginary_y, real_y, imaginary_x, real_z, imaginary_z] =
            self.vector.at(four, first, &second, Reflection::Odd);
        let [(sin, cos), _] = sines_of_turns(four, [third; 2]);
        let turned = |real: f64, imaginary: f64| real * cos - imaginary * sin;
        let turned = [turned(real_x, imaginary_x), turned(real_y, imaginary_y), turned(real_z, imaginary_z)];
        BodyState { axis, momentum, equatorial_axis: self.given(four, turned) }
    }

    /// A vector in the given frame.
    #[inline(always)]
    fn given<F: FourLanes>(&self, four: F, [x, y, z]: [f64; 3]) -> Vector3<f64> {
        let [a, b, c] = &self.columns;
        let by_z = four.multiply_add(four.load(c), four.all(z), four.all(0.0));
        let by_y = four.multiply_add(four.load(b), four.all(y), by_z);
        let [x, y, z, _] = four.store(four.multiply_add(four.load(a), four.all(x), by_y));
        Vector3::new(x, y, z)
    }
}

/// Buffer for the multiples of an angle; a small number of them needs no allocation.
#[derive(Default)]
struct Room {
    few: [[f64; 4]; FEW],
    many: Vec<[f64; 4]>,
}

/// Turns along both closed orbits per unit of time.
pub(super) fn rate_of_orbits(phases: &[Phase; 3]) -> f64 {
    phases[0].rate.high.abs() + phases[1].rate.high.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::{RigidSpheroid, RotationState};

    /// A motion of a star with `I^zz = 1.1 I^xx`.
    fn problem([s, axis, momentum]: [[f64; 3]; 3]) -> Problem<f64> {
        let axis = Vector3::from(axis).normalize();
        let equatorial_axis = axis.cross(&Vector3::new(0.3, -0.5, 0.7)).normalize();
        let start = BodyState { axis, momentum: momentum.into(), equatorial_axis };
        Problem::new(RigidSpheroid::in_units_of_tc(1.1), Matrix3::from_diagonal(&s.into()), start).unwrap()
    }

    const HIDING: [[f64; 3]; 3] = [
        [-0.0006175596873305695, -0.0006168988557999971, -0.0001367853937794081],
        [-0.03989489085848018, -0.03761937141929923, 0.9984954584660899],
        [0.8034743727762651, 0.0006186697198932354, -0.0006723004689980793],
    ];

    /// In the plane of two equal eigenvalues a deviation from rest grows in proportion to time.
    #[test]
    fn a_rest_in_the_plane_of_equal_eigenvalues_has_no_torus() {
        let near = |s: [f64; 3], place: f64, off: f64| {
            let axis = [place.sin(), off, place.cos()];
            TorusSolution::new(&problem([s, axis, [1.1 * place.sin(), 0.0, 1.1 * place.cos()]]), 1e-13, 1000.0)
        };
        for place in [0.0, 0.7] {
            for off in [0.0, 1e-9, 1e-7] {
                let why = near([0.01, -0.02, 0.01], place, off).expect_err("no torus").to_string();
                assert!(why.contains("deviations grow"), "{place} {off}: {why}");
            }
        }
    }

    /// About the axis of the highest energy a fast star is stable, and a slow one leaves the axis because its start is rounded. About the middle axis
    /// every star does.
    #[test]
    fn an_unstable_rest_has_no_torus() {
        let at = |s: [f64; 3], spin: f64, off: f64| {
            TorusSolution::new(&problem([s, [1.0, off, 0.0], [1.1 * spin, 0.0, 0.0]]), 1e-13, 1000.0)
        };
        let s = [[0.02, 0.01, -0.04], [0.01, 0.02, -0.04], [-0.04, 0.01, 0.02]];
        let [highest, middle, lowest] = s;
        for off in [0.0, 1e-13, 5e-7] {
            for (s, spin) in [(highest, 1e-3), (highest, 0.3), (middle, 1e-3), (middle, 5.0)] {
                let why = at(s, spin, off).expect_err("no torus").to_string();
                assert!(why.contains("where deviations grow"), "{s:?} {spin} {off}: {why}");
            }
        }
        // I^2 (k_1 + k_2) + G^2 = 2 I (k_1 k_2)^(1/2), in units of I and C: G = 0.141 + 0.346 for k = -0.02 and -0.12.
        let limit = (0.02_f64.sqrt() + 0.12_f64.sqrt()) / 1.1;
        assert!(at(highest, 0.99 * limit, 0.0).is_err_and(|why| why.to_string().contains("deviations grow")));
        for (s, spin) in [(highest, 1.01 * limit), (highest, 5.0), (lowest, 1e-3), (lowest, 5.0)] {
            let found = at(s, spin, 0.0);
            assert!(!found.is_err_and(|why| why.to_string().contains("deviations grow")), "{s:?} {spin}");
        }
    }

    /// With a loose tolerance, coefficients beyond small ones are larger again: between its points the first grid has errors of up to 300 times the
    /// tolerance, and for the last motion the second one is no better.
    #[test]
    fn a_grid_that_hides_coefficients_is_made_finer() {
        let as_far_on_the_second = [
            [-0.0023161338942025655, 0.0023014005625876426, -0.002315464153053399],
            [0.9990979069679238, -0.01833978332650046, -0.038301757660070296],
            [1.2089557574402616, -0.00016846807849657321, 0.0007829101182386528],
        ];
        for (tolerance, numbers) in [(1.5e-4, HIDING), (1.862e-2, as_far_on_the_second)] {
            let problem = problem(numbers);
            let [coarse, fine] = [tolerance, 1e-14].map(|digits| TorusSolution::new(&problem, digits, 100.0).unwrap());
            // The neglected coefficients, and twice a gap of ten times that.
            assert!(coarse.error_estimate(0.0) < 21.0 * tolerance + 1e-11, "{:e}", coarse.error_estimate(0.0));
            let unit = Vector3::from(numbers[2]).norm();
            for t in (0..200).map(|k| 0.37 * f64::from(k)) {
                let [[n, momentum, e_x], exact] = [&coarse, &fine].map(|found| found.state([t, 0.0]).vectors());
                let off = [n - exact[0], (momentum - exact[1]) / unit, e_x - exact[2]].map(|v| v.amax());
                assert!(off.iter().all(|&off| off < coarse.error_estimate(t)), "{off:?} at {t}");
            }
        }
    }

    /// The rounding is twice the distance of the ends of a row, if the series is closer to the flow than that.
    #[test]
    fn rows_that_do_not_close_are_rounding() {
        let torus = Torus::of(&problem([[0.2, 0.1, -0.3], [0.48, 0.6, 0.64], [0.3, -0.2, 1.5]])).unwrap();
        let phases = phases(torus.spheroid.rate_about_axis(&torus.initial[0], &torus.initial[1]), &torus.orbits);
        let mut sampled = coefficients(&torus, |quarter| torus.starts(quarter), 1e-12, FIRST_GRID).unwrap().unwrap();
        sampled.open = 1e-6;
        let (solution, gap) = TorusSolution::on(&torus, phases, 0.0, 1e-12, &sampled);
        let beyond = solution.rounding(0.0) - 2e-6;
        assert!(gap < 1e-11 && beyond > 0.0 && beyond < 1e-11, "{gap:e} {beyond:e}");
    }

    /// With wrong phases no grid is good enough: this is reported after two finer ones.
    #[test]
    fn a_series_that_does_not_follow_the_flow_is_refused() {
        let torus = Torus::of(&problem([[0.2, 0.1, -0.3], [0.48, 0.6, 0.64], [0.3, -0.2, 1.5]])).unwrap();
        let starts = |quarter: usize| torus.starts(quarter);
        let first = coefficients(&torus, starts, 1e-4, FIRST_GRID).unwrap().unwrap().grid.quarter;
        let mut wrong = phases(torus.spheroid.rate_about_axis(&torus.initial[0], &torus.initial[1]), &torus.orbits);
        wrong[0].offset += DoubleDouble::from(0.01);
        let found = TorusSolution::of(&torus, wrong, 0.0, 1e-4, starts);
        let Err(Error::NotConverged { iterations, residual, .. }) = found else { panic!("not refused") };
        assert!((1e-3..0.1).contains(&residual), "{residual:e}");
        assert_eq!(iterations, 4 * first);
    }
}
