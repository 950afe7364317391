//! The torus of a motion: a frame in which it has its symmetries, and its closed ways.

use nalgebra::{Matrix3, Matrix6x2, Vector3};

use super::flow::{Axes, DOUBLE, Integrals, joined};
use super::ways::{ClosedWays, Courses, HalfWay};
use crate::dynamics::{BodyState, Problem, RigidSpheroid, RotationState};
use crate::error::Error;
use crate::lorentz_violation::principal_frame;
use crate::numerics::scalar::Real;
use crate::solutions::averaged::mean_direction;

/// Rounding of the ends of a closed way.
pub(super) const ROUNDING: f64 = 1e-15;

/// A way that ends so near is closed.
pub(super) const CLOSED: f64 = 1e-9;

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
    /// Traceless eigenvalues of `s` along the axes, and the spread of them.
    pub(super) values: Vector3<f64>,
    pub(super) spread: f64,
    pub(super) initial: Axes<f64>,
    pub(super) ways: ClosedWays<f64>,
    pub(super) integrals: Integrals<f64>,
    pub(super) from_given: Matrix3<f64>,
}

impl Torus {
    /// The torus of a motion, in the first frame in which it has its symmetries and `accept` does not say that it has not.
    ///
    /// # Errors
    /// [`Error::Domain`] for isotropic `s`, otherwise that of the first frame: [`Error::NotConverged`].
    pub(super) fn of<R>(
        problem: &Problem<f64>,
        accept: impl Fn(&Self) -> Result<Option<R>, Error>,
    ) -> Result<(Self, R), Error> {
        let frame = principal_frame(problem.coefficients())?.principal_from_given;
        let principal = problem.rotated(&frame);
        let values = principal.coefficients().diagonal();
        let values = values.map(|value| value - values.mean());
        let spread = values.max() - values.min();
        Error::ensure(spread > 0.0, "s_max - s_min", spread, "above zero: without it there is no torus")?;
        let (spheroid, initial) = (*problem.spheroid(), principal.initial());
        let size = initial.momentum.norm();
        Error::ensure(size > 0.0, "|L|", size, "above zero: a body at rest has no torus")?;
        let mut refused = None;
        for turn in frames(&values, &mean_direction(&spheroid, &values, initial)) {
            let found = Self::in_frame(spheroid, turn.map(f64::abs) * values, spread, &initial.rotated(&turn));
            match found.map(|torus| Self { from_given: turn * frame, ..torus }) {
                Ok(torus) => {
                    if let Some(wanted) = accept(&torus)? {
                        return Ok((torus, wanted));
                    }
                }
                Err(error) => _ = refused.get_or_insert(error),
            }
        }
        let what = "torus with the symmetry of reflections in principal planes";
        Err(refused.unwrap_or(Error::NotConverged { what, iterations: 6, residual: f64::NAN }))
    }

    fn in_frame(
        spheroid: RigidSpheroid<f64>,
        values: Vector3<f64>,
        spread: f64,
        initial: &BodyState<f64>,
    ) -> Result<Self, Error> {
        let integrals = Integrals::new(&spheroid, &Matrix3::from_diagonal(&values), spread, DOUBLE);
        let start = [initial.axis, initial.momentum, initial.equatorial_axis];
        let courses = Courses::new(&integrals, &spheroid, &values, initial);
        let ways = courses.closed_ways(&start)?;
        Ok(Self { spheroid, values, spread, initial: start, ways, integrals, from_given: Matrix3::identity() })
    }

    /// How far the way from the state in the plane ends from the initial state. Large where rounding grows, near the separatrix.
    pub(super) fn gap(&self) -> f64 {
        let [n, momentum, _] = self.integrals.moved(self.ways.to_plane.times.map(|time| -time), &self.ways.plane);
        let [start, start_momentum, _] = &self.initial;
        (n - start).amax().max((momentum - start_momentum).amax() / self.size())
    }

    /// Singular values of the rates of both flows at the state in the plane: the second is zero for a thin torus.
    pub(super) fn widths(&self) -> [f64; 2] {
        let columns = self.integrals.both_rates(&self.ways.plane).map(|rates| joined(&rates, self.size(), f64::re));
        let values = Matrix6x2::from_columns(&columns).singular_values();
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
        (n.x.abs().max((momentum.x / self.size()).abs()) < EXACT).then_some(starts)
    }

    /// `|L|`.
    pub(super) fn size(&self) -> f64 {
        self.initial[1].norm()
    }
}

/// Frames with the principal axes in any order, first that in which the averaged `L` goes round Z and Y is the axis of the middle eigenvalue: the averaged `L` is
/// fastest where it crosses the plane of the other two.
fn frames(values: &Vector3<f64>, direction: &Vector3<f64>) -> [Matrix3<f64>; 6] {
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
    let [high, y, low] = order;
    let level = (0..3).map(|i| (values[i] - values[y]) * direction[i] * direction[i]).sum::<f64>();
    let [x, z] = if level > 0.0 { [low, high] } else { [high, low] };
    [[x, y], [y, x], [z, y], [y, z], [x, z], [z, x]].map(|axes| {
        let [x, y] = axes.map(|i| Vector3::ith(i, 1.0));
        Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()])
    })
}
