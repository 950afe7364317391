//! The motion as a Fourier series on its torus: any state at any time at the same cost.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

use super::found::{THINNEST, Torus};
use super::phase::{Phase, phases};
use super::sampling::{ROUNDING, Sampled, coefficients};
use super::table::{Multiples, Table};
use super::wide::WideTorus;
use crate::dynamics::{AxisState, BodyState, Problem};
use crate::error::Error;
use crate::numerics::angle::sin_cos_of_turns;
use crate::numerics::arithmetic::plain;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::four_lanes::FourLanes;
use crate::numerics::fused::{Fused, detect_fused, run_fused};

/// What the rounding of the flow and of the initial state leaves at the end of half a closed way.
const END_OF_HALF_WAY: f64 = 5e-16;

/// What may be left between the series and the flow beside its estimated error, where its torus has the symmetries assumed.
const CLOSED: f64 = 1e-12;

/// What rounding leaves of derivatives where both flows differ most: that of some ten steps of the flow, and of their sum.
const ROUNDING_OF_DERIVATIVES: f64 = 1e-14;

/// So many blocks of multiples of both angles fit on the stack: of cosines and of sines.
const FEW: usize = 16;

/// The exact motion from an initial state: `n`, `L` and `e_x` as Fourier series of two angles that grow in proportion to time, and a third one that turns
/// `e_x` about `n`.
///
/// ```text
/// (n, L)(t) = sum_jk (n, L)_jk exp i (j theta_1 + k theta_2),    theta_i = theta_i0 + w_i t
/// ```
///
/// `theta_1` is a turn of `n` about `L` from the plane of `L` and Z, `theta_2` one of the averaged `L` about Z, the principal axis of `s` that it goes round. The
/// coefficients are those of the motion along the commuting flows of `H` and `K` on a grid of the torus. See `docs/exact-motion.md`.
#[derive(Debug, Clone)]
pub struct TorusSolution {
    pub(super) phases: [Phase; 3],
    /// Times along the flows of `H` and `K` of both closed ways, and the spread that is the unit of `K`.
    pub(super) periods: [[f64; 2]; 2],
    pub(super) spread: f64,
    /// Unit of `L`.
    pub(super) unit: f64,
    /// How much the flows differ: the least over the largest singular value of their rates.
    width: f64,
    /// Of `n` and `L`.
    axes: Table,
    /// Of `V`, from which `e_x` is turned.
    vector: Table,
    /// Blocks of four multiples of both angles that are needed.
    blocks: [usize; 2],
    pub(super) given_from_torus: Matrix3<f64>,
    truncation: f64,
    /// Difference of the series from the flow, and the rounding of so many terms.
    off: f64,
    /// Error of a state per unit of time, by the rates.
    drift: f64,
    fused: Option<Fused>,
}

impl TorusSolution {
    /// The motion of a problem, with the largest error wanted of the components of `n`, `e_x` and `L`, for times up to `longest` in size. For long ones
    /// the closed ways are found to 32 digits, which takes a few ms.
    ///
    /// # Errors
    /// [`Error::Domain`] for isotropic `s`; [`Error::NotConverged`] where the closed ways are not found, or need more coefficients than a table may have: near the
    /// separatrix; [`Error::Unsupported`] for a star with a bulge.
    pub fn new(problem: &Problem<f64>, tolerance: f64, longest: f64) -> Result<Self, Error> {
        problem.require_rigid()?;
        let tolerance = tolerance.max(ROUNDING);
        let torus = Torus::of(problem)?;
        let near = phases(&torus.spheroid, &torus.initial, &torus.ways);
        let drift = rate_of_ways(&near) * 2.0 * END_OF_HALF_WAY;
        if longest.abs() * drift <= 0.3 * tolerance
            && let Some(functions) = coefficients(&torus, |quarter| torus.starts(quarter), tolerance)?
        {
            return Self::on(&torus, near, drift, tolerance, functions);
        }
        let wide = WideTorus::near(&torus, problem)?;
        let torus = wide.rounded(&torus);
        let starts = |quarter: usize| torus.starts(quarter).unwrap_or_else(|| wide.starts(quarter));
        let functions = coefficients(&torus, |quarter| Some(starts(quarter)), tolerance)?;
        let what = "Fourier series on the torus";
        let functions = functions.ok_or(Error::NotConverged { what, iterations: 1, residual: f64::NAN })?;
        Self::on(&torus, wide.phases, wide.drift, tolerance, functions)
    }

    /// The series on a torus with these phases.
    ///
    /// # Errors
    /// [`Error::NotConverged`] if they are not those of the motion.
    fn on(torus: &Torus, phases: [Phase; 3], drift: f64, tolerance: f64, sampled: Sampled) -> Result<Self, Error> {
        let (mut axes, left_axes) = Table::within(&sampled.axes, tolerance);
        let (vector, left_vector) = Table::within(&sampled.vector, tolerance);
        axes.scale_every_other(torus.unit);
        let [[a, b], [c, d]] = [axes.blocks(), vector.blocks()];
        let [most, least] = torus.widths();
        let mut solution = Self {
            width: least / most,
            phases,
            periods: [&torus.ways.fast, &torus.ways.slow].map(|half| half.times.map(|time| time * 2.0)),
            spread: torus.spread,
            unit: torus.unit,
            axes,
            vector,
            blocks: [a.max(c), b.max(d)],
            given_from_torus: torus.from_given.transpose(),
            truncation: left_axes.max(left_vector),
            off: 0.0,
            drift,
            fused: detect_fused(),
        };
        let gap = solution.gap(torus);
        let terms = (solution.axes.len() + solution.vector.len()) as f64;
        solution.off = 2.0 * gap.max(sampled.open) + 0.5 * ROUNDING * terms.sqrt();
        if gap <= 10.0 * solution.truncation + CLOSED {
            return Ok(solution);
        }
        Err(Error::NotConverged { what: "Fourier series on the torus, against its flow", iterations: 1, residual: gap })
    }

    /// Largest difference from the start, and from the flow at a point where all functions differ from one another.
    fn gap(&self, torus: &Torus) -> f64 {
        let parts = [0.2, 0.06];
        let times = [0, 1].map(|i| (0..2).map(|way| self.periods[way][i] * parts[way]).sum());
        let [n, momentum, u] = torus.integrals.moved(times, &torus.ways.plane);
        let turned = 2.0 * (torus.ways.fast.turn * parts[0] + torus.ways.slow.turn * parts[1]);
        let there = self.state_on_torus([parts[0], parts[1], 0.0]);
        let here = self.state([0.0; 2]);
        let turn = &torus.from_given;
        let differences = [
            turn * there.axis - n,
            (turn * there.momentum - momentum) / torus.unit,
            turn * there.equatorial_axis - (u * turned.cos() - n.cross(&u) * turned.sin()),
            turn * here.axis - torus.initial[0],
            (turn * here.momentum - torus.initial[1]) / torus.unit,
            turn * here.equatorial_axis - torus.initial[2],
        ];
        // A NaN is a gap too.
        differences.iter().flatten().fold(0.0, |most, x| if x.abs() <= most { most } else { x.abs() })
    }

    /// Rates of the angles (rad per unit of time): of `n` about `L` from the plane of `L` and Z, of the averaged `L` about Z, and of `e_x` about `n`.
    pub fn rates(&self) -> [f64; 3] {
        self.phases.map(|phase| phase.rate.high * TAU)
    }

    /// Number of pairs of frequencies in the series of `n` and `L`, and in that of `e_x`.
    pub fn term_counts(&self) -> [usize; 2] {
        [self.axes.len(), self.vector.len()]
    }

    /// Sum of the coefficients that were left out: error of the series, rounding apart.
    pub fn truncation(&self) -> f64 {
        self.truncation
    }

    /// Estimated rounding at a time since the start: of the sums, of the coefficients by what is left between the series and the flow, and of the rates.
    pub fn rounding(&self, t: f64) -> f64 {
        8.0 * ROUNDING + self.off + self.drift * t.abs()
    }

    /// Estimated error of the components of `n`, `e_x` and `L` at a time since the start, of `L` in units of its size at the start or of `(2 I^xx |C| (s_max - s_min))^(1/2)`, which the torque can
    /// give it, if that is larger.
    pub fn error_estimate(&self, t: f64) -> f64 {
        self.truncation + self.rounding(t)
    }

    /// Estimated error of derivatives ([`TorusDerivative`](super::TorusDerivative)) in units of the largest one by the same parameter.
    ///
    /// # Errors
    /// [`Error::NotConverged`] for a torus so thin that its flows hardly differ: `n` on `L`, `L` on an axis. Neighbours of such a motion have another number of frequencies.
    pub fn error_of_derivatives(&self) -> Result<f64, Error> {
        if self.width <= THINNEST {
            let what = "derivatives on the torus: n is on L, or L on an axis";
            return Err(Error::NotConverged { what, iterations: 1, residual: self.width });
        }
        Ok(ROUNDING_OF_DERIVATIVES / self.width)
    }

    /// `n` and `L` at the time `t[0] + t[1]` since the start.
    pub fn axis_state(&self, t: [f64; 2]) -> AxisState<f64> {
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

    /// The state at three angles of the torus, in turns.
    pub fn state_on_torus(&self, turns: [f64; 3]) -> BodyState<f64> {
        self.state_at(plain(), turns)
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
        self.with_multiples(four, turns, |first, second| self.axes_at(four, first, second))
    }

    #[inline(always)]
    fn state_by<F: FourLanes>(&self, four: F, t: [f64; 2]) -> BodyState<f64> {
        let [first, second, third] = &self.phases;
        self.state_at(four, [first.at::<F>(t), second.at::<F>(t), third.at::<F>(t)])
    }

    /// Uses all multiples of two angles.
    #[inline(always)]
    fn with_multiples<F: FourLanes, R>(
        &self,
        four: F,
        [a, b]: [f64; 2],
        sum: impl FnOnce(&Multiples<'_>, &Multiples<'_>) -> R,
    ) -> R {
        let [first, second] = self.blocks.map(|blocks| 2 * blocks);
        let mut few = [[0.0; 4]; FEW];
        let mut many = Vec::new();
        let all = if first + second <= FEW {
            &mut few[..first + second]
        } else {
            many.resize(first + second, [0.0; 4]);
            many.as_mut_slice()
        };
        let (of_first, of_second) = all.split_at_mut(first);
        let first = Multiples::fill(four, of_first, sin_cos_of_turns::<F>(a));
        let second = Multiples::fill(four, of_second, sin_cos_of_turns::<F>(b));
        sum(&first, &second)
    }

    #[inline(always)]
    fn axes_at<F: FourLanes>(&self, four: F, first: &Multiples<'_>, second: &Multiples<'_>) -> AxisState<f64> {
        let values = self.axes.at(four, first, second);
        let ([x, lx, y, ly], [z, lz]) = (values.changing, values.even);
        AxisState {
            axis: self.given_from_torus * Vector3::new(x, y, z),
            momentum: self.given_from_torus * Vector3::new(lx, ly, lz),
        }
    }

    #[inline(always)]
    fn state_at<F: FourLanes>(&self, four: F, [first, second, third]: [f64; 3]) -> BodyState<f64> {
        let (AxisState { axis, momentum }, values) = self.with_multiples(four, [first, second], |first, second| {
            (self.axes_at(four, first, second), self.vector.at(four, first, second))
        });
        let ([real_x, imaginary_y, real_y, imaginary_x], [real_z, _], [_, imaginary_z]) =
            (values.changing, values.even, values.odd);
        let (sin, cos) = sin_cos_of_turns::<F>(third);
        let turned =
            Vector3::new(real_x, real_y, real_z) * cos - Vector3::new(imaginary_x, imaginary_y, imaginary_z) * sin;
        BodyState { axis, momentum, equatorial_axis: self.given_from_torus * turned }
    }
}

/// Turns along both closed ways per unit of time.
pub(super) fn rate_of_ways(phases: &[Phase; 3]) -> f64 {
    phases[0].rate.high.abs() + phases[1].rate.high.abs()
}
