//! Outputs and their derivatives by named parameters of a scene.

use nalgebra::{DMatrix, Matrix3};
use num_dual::Dual64;

use super::{Method, Plan, Start, State};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::propagation::{AxisMotion, AxisState, Motion, SymmetricMotion, UniformMotion, propagate, propagate_axis};
use crate::scalar::Real;

/// Functions of the state at one time, for any scalar. How the derivatives of the state are made is not their concern.
pub trait StateFunction {
    /// How many values there are.
    fn len(&self) -> usize;

    /// Whether there are none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Writes the values into `values`, [`len`](Self::len) of them. The equatorial axis is zero where the plan does not carry it.
    fn values<S: Real>(&self, spheroid: &RigidSpheroid<S>, s: &Matrix3<S>, state: &BodyState<S>, values: &mut [S]);
}

/// Values of outputs at samples, and their derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// A row for each time, a column for each value.
    pub values: DMatrix<f64>,
    /// For each time a matrix with a row for each value and a column for each parameter of the plan.
    pub jacobians: Vec<DMatrix<f64>>,
}

/// Values of `outputs` at `times` and their derivatives by the [`derivatives`](Plan::derivatives) of a plan, and by no others.
///
/// A forward dual through the motion that the plan chose for each parameter; the steps are those of the motion itself, so that
/// the derivatives are those of the solution: as accurate as it is, relative to the largest one.
///
/// # Errors
/// As for the motion; [`Error::Domain`] for times outside its stretch.
pub fn gradient(
    plan: &Plan,
    start: &Start<f64>,
    outputs: &impl StateFunction,
    times: &[f64],
) -> Result<Gradient, Error> {
    let (width, count) = (outputs.len(), plan.derivatives.len());
    let mut values = DMatrix::zeros(times.len(), width);
    let mut jacobians = vec![DMatrix::zeros(width, count); times.len()];
    if count == 0 {
        let motion = SeededMotion::new(plan, start)?;
        let mut here = vec![0.0; width];
        for (row, &t) in times.iter().enumerate() {
            outputs.values(&start.spheroid, &start.violation, &motion.state(t)?, &mut here);
            values.row_mut(row).iter_mut().zip(&here).for_each(|(value, here)| *value = *here);
        }
    }
    let mut here = vec![Dual64::from_re(0.0); width];
    for (index, parameter) in plan.derivatives.iter().enumerate() {
        let mut seeded = start.lifted::<Dual64>();
        parameter.add(&mut seeded, Dual64::new(0.0, 1.0));
        let motion = SeededMotion::new(plan, &seeded)?;
        for (row, &t) in times.iter().enumerate() {
            let state = motion.state(Dual64::from_re(t))?;
            outputs.values(&seeded.spheroid, &seeded.violation, &state, &mut here);
            for (column, value) in here.iter().enumerate() {
                values[(row, column)] = value.re;
                jacobians[row][(column, index)] = value.eps;
            }
        }
    }
    Ok(Gradient { values, jacobians })
}

/// The motion of a plan for duals.
enum SeededMotion<S> {
    Uniform(UniformMotion<S>),
    Symmetric(SymmetricMotion<S>),
    Taylor(crate::propagation::TaylorMotion<S>),
    TaylorAxis(crate::propagation::TaylorAxisMotion<S>),
}

impl<S: Real> SeededMotion<S> {
    fn new(plan: &Plan, start: &Start<S>) -> Result<Self, Error> {
        let Start { spheroid, violation, .. } = start;
        let (initial, span) = (start.state(), plan.stretch);
        Ok(match plan.method {
            Some(Method::Free | Method::Steady) => {
                Self::Uniform(UniformMotion::free(spheroid, violation, &initial, span))
            }
            Some(Method::Symmetric) => Self::Symmetric(SymmetricMotion::new(spheroid, violation, &initial, span)?),
            Some(Method::Taylor | Method::Splitting) | None if plan.state == State::Orientation => {
                Self::Taylor(propagate(spheroid, violation, &initial, span, plan.accuracy)?)
            }
            Some(Method::Taylor | Method::Splitting) | None => {
                let initial = AxisState::from(&initial);
                Self::TaylorAxis(propagate_axis(spheroid, violation, &initial, span, plan.accuracy)?)
            }
        })
    }

    fn state(&self, t: S) -> Result<BodyState<S>, Error> {
        match self {
            Self::Uniform(motion) => motion.state(t),
            Self::Symmetric(motion) => motion.state(t),
            Self::Taylor(motion) => motion.state(t),
            Self::TaylorAxis(motion) => {
                let AxisState { axis, momentum } = motion.axis_state(t)?;
                Ok(BodyState { axis, momentum, equatorial_axis: nalgebra::Vector3::zeros() })
            }
        }
    }
}
