//! The torus of a motion: a frame in which it has its symmetries, and its closed ways.

use nalgebra::{Matrix3, Vector3};

use super::flow::{Axes, DOUBLE, Integrals, tangents};
use super::walk::lattice;
use super::ways::{ClosedWays, HalfWay};
use crate::dynamics::{BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::lorentz_violation::principal_frame;
use crate::solutions::averaged::mean_direction;

/// Rounding of the ends of a closed way.
pub(super) const ROUNDING: f64 = 1e-15;

/// What rounding may leave after a quarter of a turn.
const EXACT: f64 = 2e-15;

/// A torus whose two flows differ by less than this, relative, is a circle or a point.
pub(super) const THINNEST: f64 = 1e-8;

/// A closed way on the torus: along the flow of `H` for the first time and along that of `K` for the second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Period {
    pub(super) times: [f64; 2],
    /// Turn of the body about `n` (rad).
    pub(super) turn: f64,
    /// Estimated error of the times.
    pub(super) error: f64,
}

/// A torus with what it was found from, in a frame in which half a turn about Z takes it to itself.
#[derive(Debug, Clone)]
pub(super) struct Torus {
    pub(super) spheroid: RigidSpheroid<f64>,
    /// Eigenvalues of `s` along the axes less the middle one, and the spread of them.
    pub(super) values: Vector3<f64>,
    pub(super) spread: f64,
    /// Unit of `L`: its size at the start, or `(2 I^xx |C| (s_max - s_min))^(1/2)`, which the torque can give it, if that is larger.
    pub(super) unit: f64,
    pub(super) initial: Axes<f64>,
    pub(super) ways: ClosedWays<f64>,
    pub(super) integrals: Integrals<f64>,
    pub(super) from_given: Matrix3<f64>,
}

impl Torus {
    /// The torus of a motion, in a frame with Y the axis of the middle eigenvalue and Z one of the other two about which half a turn takes it to itself.
    ///
    /// # Errors
    /// [`Error::Domain`] for isotropic `s`; [`Error::NotConverged`] where the walk over the torus does not find its symmetric states.
    pub(super) fn of(problem: &Problem<f64>) -> Result<Self, Error> {
        let frame = principal_frame(problem.coefficients())?.principal_from_given;
        let principal = problem.rotated(&frame);
        let mut values = principal.coefficients().diagonal();
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
        let [high, middle, low] = order;
        values.add_scalar_mut(-values[middle]);
        let spread = values[high] - values[low];
        Error::ensure(spread > 0.0, "s_max - s_min", spread, "above zero: without it there is no torus")?;
        let (spheroid, initial) = (*problem.spheroid(), principal.initial());
        let pull = (2.0 * spheroid.inertia_xx * spheroid.constant_c.abs() * spread).sqrt();
        let unit = initial.momentum.norm().max(pull);
        // Where L is fast it goes round the axis on whose side of the separatrix it is.
        let level = values.dot(&initial.momentum.component_mul(&initial.momentum));
        let [x, z] = if level > 0.0 { [low, high] } else { [high, low] };
        let in_frame = |x: usize| {
            let [x, y] = [x, middle].map(|i| Vector3::ith(i, 1.0));
            let turn = Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
            let values = turn.map(f64::abs) * values;
            let integrals = Integrals::new(&spheroid, &Matrix3::from_diagonal(&values), spread, DOUBLE);
            let initial = initial.rotated(&turn);
            let start = [initial.axis, initial.momentum, initial.equatorial_axis];
            (turn, values, integrals, start)
        };
        let lost = |what| Error::NotConverged { what, iterations: 1, residual: f64::NAN };
        let (turn, values_in_frame, integrals, start) = in_frame(x);
        let found =
            lattice(&integrals, unit, &start).ok_or(lost("symmetric states of the torus, as near the separatrix"))?;
        let (turn, values, integrals, initial) =
            if found.about_x { in_frame(z) } else { (turn, values_in_frame, integrals, start) };
        let ways = ClosedWays::near(&integrals, unit, &initial, [found.to_plane, found.fast, found.slow]);
        let ways = ways.ok_or(lost("closed ways of the torus, as near the separatrix"))?;
        Ok(Self { spheroid, values, spread, unit, initial, ways, integrals, from_given: turn * frame })
    }

    /// Singular values of the rates of both flows at the state in the plane: the second is zero for a thin torus.
    pub(super) fn widths(&self) -> [f64; 2] {
        let values = tangents(&self.integrals.both_rates(&self.ways.plane), self.unit).singular_values();
        [values.max(), values.min()]
    }

    /// Both closed ways.
    ///
    /// # Errors
    /// [`Error::NotConverged`] for a torus so thin that its flows hardly differ.
    pub(super) fn periods(&self) -> Result<[Period; 2], Error> {
        let [most, least] = self.widths();
        if least <= THINNEST * most {
            let what = "periods of the torus: n is on L, or L on an axis";
            return Err(Error::NotConverged { what, iterations: 1, residual: least / most });
        }
        let whole = |half: &HalfWay<f64>| Period {
            times: half.times.map(|time| 2.0 * time),
            turn: 2.0 * half.turn,
            error: ROUNDING / least,
        };
        Ok([whole(&self.ways.fast), whole(&self.ways.slow)])
    }

    /// The axis of the given frame, which is a principal one, that the averaged `L` goes round.
    pub(super) fn axis(&self) -> usize {
        self.from_given.row(2).transpose().iamax()
    }

    /// Whether the averaged `L` goes round the positive end of the principal axis in the positive sense, as it does along the flow of `K` near the
    /// axis of the largest eigenvalue on the positive side.
    pub(super) fn sense(&self) -> f64 {
        let [axis, momentum, equatorial_axis] = self.ways.plane;
        let l = mean_direction(&self.spheroid, &self.values, &BodyState { axis, momentum, equatorial_axis });
        let end = self.from_given.row(2)[self.axis()].signum();
        let high = if self.values.z > self.values.y { 1.0 } else { -1.0 };
        high * l.z.signum() * end
    }

    /// States along a quarter of a turn of the second angle, where they are as exact as the flow: the last one must be in the plane `X = 0`. Rounding grows
    /// near the separatrix.
    pub(super) fn starts(&self, quarter: usize) -> Option<Vec<Axes<f64>>> {
        let starts = self.ways.starts(&self.integrals, quarter);
        let [n, momentum, _] = starts[quarter];
        (n.x.abs().max((momentum.x / self.unit).abs()) < EXACT).then_some(starts)
    }
}
