//! Outputs and their derivatives by named parameters of a scene.

use nalgebra::{DMatrix, Matrix3, Vector3};
use num_dual::Dual64;

use super::{Method, Parameter, Plan, Start, State};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::{PrincipalCoefficients, principal_frame_along, principal_frame_with_derivatives};
#[cfg(target_arch = "x86_64")]
use crate::propagation::check_time;
#[cfg(target_arch = "x86_64")]
use crate::propagation::splitting::derivatives::{Seeded, states_with_derivatives};
use crate::propagation::{
    AveragedMotion, AxisMotion, AxisState, Motion, SymmetricMotion, UniformMotion, propagate, propagate_axis,
};
use crate::scalar::Real;
use crate::solutions::mean::MeanOrder;

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
/// Where the motion is numerical and the Taylor series was not asked for by name, it goes by a splitting scheme with the tangent map of
/// each of its flows, for all parameters at once, and the outputs follow by forward duals: values and derivatives of one numerical
/// motion, made for the accuracy of the plan, relative to the largest derivative. Otherwise (and on processors without vectors of
/// doubles, and for values without derivatives) by the closed form or the series, with a forward dual through it for each parameter; steps
/// follow from real parts alone, and the error of derivatives through the series can be some hundred times that of the motion.
///
/// # Errors
/// As for the motion; [`Error::Domain`] for times outside its stretch.
pub fn gradient(
    plan: &Plan,
    start: &Start<f64>,
    outputs: &impl StateFunction,
    times: &[f64],
) -> Result<Gradient, Error> {
    let in_parts: Vec<[f64; 2]> = times.iter().map(|&t| [t, 0.0]).collect();
    gradient_in_parts(plan, start, outputs, &in_parts)
}

/// As [`gradient`], at times that are sums of two doubles. The mean motion uses both: after 1e10 turns a double does not hold where in its
/// turn a body is. Other motions take the sum.
///
/// # Errors
/// As for [`gradient`].
pub fn gradient_in_parts(
    plan: &Plan,
    start: &Start<f64>,
    outputs: &impl StateFunction,
    times: &[[f64; 2]],
) -> Result<Gradient, Error> {
    let (width, count) = (outputs.len(), plan.derivatives.len());
    let mut found = Gradient {
        values: DMatrix::zeros(times.len(), width),
        jacobians: vec![DMatrix::zeros(width, count); times.len()],
    };
    if times.is_empty() {
        return Ok(found);
    }
    if count == 0 {
        found.values = values(plan, start, outputs, times)?;
        return Ok(found);
    }
    let seeded: Vec<Start<Dual64>> = plan.derivatives.iter().map(|parameter| start.seeded(*parameter)).collect();
    let mut here = vec![Dual64::from_re(0.0); width];
    let mut write = |row: usize, index: usize, seeded: &Start<Dual64>, state: &BodyState<Dual64>| {
        outputs.values(&seeded.spheroid, &seeded.violation, state, &mut here);
        for (column, value) in here.iter().enumerate() {
            found.values[(row, column)] = value.re;
            found.jacobians[row][(column, index)] = value.eps;
        }
    };
    let sums: Vec<f64> = times.iter().map(|t| t[0] + t[1]).collect();
    if let Some(states) = states_by_splitting(plan, &seeded, &sums)? {
        for (row, states) in states.iter().enumerate() {
            for (index, (seeded, state)) in seeded.iter().zip(states).enumerate() {
                write(row, index, seeded, state);
            }
        }
        return Ok(found);
    }
    for (index, seeded) in seeded.iter().enumerate() {
        let motion = SeededMotion::new(plan, seeded, principal_frame_along)?;
        for (row, &t) in times.iter().enumerate() {
            write(row, index, seeded, &motion.state(t)?);
        }
    }
    if plan.method == Some(Method::Mean) {
        // Derivatives take nearly equal eigenvalues for equal: values do not.
        found.values = values(plan, start, outputs, times)?;
    }
    Ok(found)
}

fn values(
    plan: &Plan,
    start: &Start<f64>,
    outputs: &impl StateFunction,
    times: &[[f64; 2]],
) -> Result<DMatrix<f64>, Error> {
    let motion = SeededMotion::new(plan, start, principal_frame_with_derivatives)?;
    let mut found = DMatrix::zeros(times.len(), outputs.len());
    let mut here = vec![0.0; outputs.len()];
    for (row, &t) in times.iter().enumerate() {
        outputs.values(&start.spheroid, &start.violation, &motion.state(t)?, &mut here);
        found.row_mut(row).iter_mut().zip(&here).for_each(|(value, here)| *value = *here);
    }
    Ok(found)
}

impl Start<f64> {
    /// The scene as a function of one parameter, at the value it has.
    fn seeded(&self, parameter: Parameter) -> Start<Dual64> {
        let mut seeded = self.lifted();
        parameter.add(&mut seeded, Dual64::new(0.0, 1.0));
        seeded
    }
}

/// The state at each time as a function of each parameter, where splitting gives it.
#[cfg(target_arch = "x86_64")]
fn states_by_splitting(
    plan: &Plan,
    seeded: &[Start<Dual64>],
    times: &[f64],
) -> Result<Option<Vec<Vec<BodyState<Dual64>>>>, Error> {
    let by_series = plan.forced && plan.method == Some(Method::Taylor);
    if by_series || !matches!(plan.method, Some(Method::Taylor | Method::Splitting)) {
        return Ok(None);
    }
    let (first, _) = plan.stretch;
    times.iter().try_for_each(|&t| check_time(plan.stretch, t))?;
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|&a, &b| (times[a] - first).abs().total_cmp(&(times[b] - first).abs()));
    let sorted: Vec<f64> = order.iter().map(|&place| times[place]).collect();
    let found = if plan.state == State::Orientation {
        let vectors = |state: BodyState<_>| [state.axis, state.momentum, state.equatorial_axis];
        states_with_derivatives(&carrying(seeded, vectors), first, &sorted, plan.accuracy)?
    } else {
        let vectors = |state: BodyState<_>| [state.axis, state.momentum];
        states_with_derivatives(&carrying(seeded, vectors), first, &sorted, plan.accuracy)?
    };
    let Some(found) = found else { return Ok(None) };
    let mut states = vec![Vec::new(); times.len()];
    for (place, state) in order.into_iter().zip(found) {
        states[place] = state;
    }
    Ok(Some(states))
}

/// The scenes with those vectors of their initial states that a motion carries.
#[cfg(target_arch = "x86_64")]
fn carrying<const V: usize>(
    starts: &[Start<Dual64>],
    vectors: impl Fn(BodyState<Dual64>) -> [Vector3<Dual64>; V],
) -> Vec<Seeded<V>> {
    let seeded = |start: &Start<Dual64>| {
        let Start { spheroid, violation, .. } = *start;
        Seeded { spheroid, violation, initial: vectors(start.state()) }
    };
    starts.iter().map(seeded).collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn states_by_splitting(_: &Plan, _: &[Start<Dual64>], _: &[f64]) -> Result<Option<Vec<Vec<BodyState<Dual64>>>>, Error> {
    Ok(None)
}

/// Eigenvalues of `s^IJ` and the rotation to its principal frame.
type Frame<S> = fn(&Matrix3<S>) -> Result<(PrincipalCoefficients<S>, Matrix3<S>), Error>;

/// The motion of a plan for duals.
enum SeededMotion<S> {
    Uniform(UniformMotion<S>),
    Symmetric(SymmetricMotion<S>),
    Mean(AveragedMotion<S>),
    Taylor(crate::propagation::TaylorMotion<S>),
    TaylorAxis(crate::propagation::TaylorAxisMotion<S>),
}

impl<S: Real> SeededMotion<S> {
    fn new(plan: &Plan, start: &Start<S>, frame: Frame<S>) -> Result<Self, Error> {
        let Start { spheroid, violation, .. } = start;
        let (initial, span) = (&start.state(), plan.stretch);
        Ok(match plan.method {
            Some(Method::Free | Method::Steady) => {
                Self::Uniform(UniformMotion::free(spheroid, violation, initial, span))
            }
            Some(Method::Symmetric) => Self::Symmetric(SymmetricMotion::new(spheroid, violation, initial, span)?),
            Some(Method::Mean) => {
                let frame = frame(violation)?;
                Self::Mean(AveragedMotion::in_frame(spheroid, violation, initial, span, MeanOrder::Second, frame)?)
            }
            Some(Method::Taylor | Method::Splitting) | None if plan.state == State::Orientation => {
                Self::Taylor(propagate(spheroid, violation, initial, span, plan.accuracy)?)
            }
            Some(Method::Taylor | Method::Splitting) | None => {
                let initial = AxisState::from(initial);
                Self::TaylorAxis(propagate_axis(spheroid, violation, &initial, span, plan.accuracy)?)
            }
        })
    }

    fn state(&self, t: [f64; 2]) -> Result<BodyState<S>, Error> {
        match self {
            Self::Uniform(motion) => motion.state_in_parts(t),
            Self::Symmetric(motion) => motion.state_in_parts(t),
            Self::Mean(motion) => motion.state_in_parts(t),
            Self::Taylor(motion) => motion.state_in_parts(t),
            Self::TaylorAxis(motion) => {
                let AxisState { axis, momentum } = motion.axis_state_in_parts(t)?;
                Ok(BodyState { axis, momentum, equatorial_axis: Vector3::zeros() })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::euler_angles::{EulerAngles, EulerRates};
    use crate::plan::{Output, Request};

    /// The first of the components of `n`.
    struct Components(usize);

    impl StateFunction for Components {
        fn len(&self) -> usize {
            self.0
        }

        fn values<S: Real>(&self, _: &RigidSpheroid<S>, _: &Matrix3<S>, state: &BodyState<S>, values: &mut [S]) {
            values.copy_from_slice(&state.axis.as_slice()[..self.0]);
        }
    }

    fn start(s: [f64; 3]) -> Start<f64> {
        Start {
            spheroid: RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.1, constant_c: 0.7 },
            violation: Matrix3::from_diagonal(&Vector3::from(s)),
            angles: EulerAngles { alpha: 0.3, beta: 0.7, gamma: 0.1 },
            rates: EulerRates { alpha: 1.4, beta: 0.1, gamma: 0.2 },
        }
    }

    fn plan(start: &Start<f64>, method: Method, span: (f64, f64), accuracy: f64) -> Plan {
        let derivatives = vec![Parameter::Beta, Parameter::ConstantC];
        let request = Request::new(&[Output::SymmetryAxis], span, 3, accuracy);
        let request = Request { method: Some(method), derivatives, ..request };
        Plan::new(&start.spheroid, &start.violation, &start.state(), &request).unwrap()
    }

    #[test]
    fn functions_without_values_are_empty() {
        assert_eq!([0, 1, 2].map(|count| Components(count).is_empty()), [true, false, false]);
    }

    #[test]
    fn only_series_asked_for_by_name_are_used_for_numerical_gradients() {
        let start = start([0.2, 0.1, -0.3]);
        let by = |method, forced| {
            let plan = Plan { forced, ..plan(&start, method, (0.0, 20.0), 1e-5) };
            gradient(&plan, &start, &Components(3), &[7.0, 19.0]).unwrap()
        };
        let splitting = by(Method::Splitting, true);
        assert_eq!(by(Method::Splitting, false), splitting);
        assert_eq!(by(Method::Taylor, false), splitting);
        #[cfg(target_arch = "x86_64")]
        if pulp::x86::V3::try_new().is_some() {
            assert_ne!(by(Method::Taylor, true), splitting);
        }
    }

    #[test]
    fn times_may_come_in_any_order() {
        let start = start([0.2, 0.1, -0.3]);
        let plan = plan(&start, Method::Splitting, (20.0, -10.0), 1e-5);
        let at = |times: &[f64]| gradient(&plan, &start, &Components(3), times).unwrap();
        let (mixed, ordered) = (at(&[-8.0, 15.0, 3.0]), at(&[15.0, 3.0, -8.0]));
        for (place, ordered_place) in [(0, 2), (1, 0), (2, 1)] {
            assert_eq!(mixed.values.row(place), ordered.values.row(ordered_place));
            assert_eq!(mixed.jacobians[place], ordered.jacobians[ordered_place]);
        }
    }

    /// Derivatives of the mean motion take eigenvalues for equal that are nearly so.
    #[test]
    fn values_of_the_mean_motion_are_those_without_derivatives() {
        let start = start([2e-6, -1e-6 + 1.2e-14, -1e-6 - 1.2e-14]);
        let with_derivatives = plan(&start, Method::Mean, (0.0, 1e6), 1e-2);
        let without = Plan { derivatives: Vec::new(), ..with_derivatives.clone() };
        let values = |plan: &Plan| gradient(plan, &start, &Components(3), &[3e5, 1e6]).unwrap().values;
        assert_eq!(values(&with_derivatives), values(&without));
    }
}
