//! Outputs and their derivatives with respect to named parameters of a scene.

use nalgebra::DMatrix;
use num_dual::Dual64;

use super::{Method, Plan, State};
use crate::dynamics::{BodyState, Problem, RotationState};
use crate::error::Error;
use crate::lorentz_violation::principal_frame_along;
use crate::parameters::Parameters;
#[cfg(target_arch = "x86_64")]
use crate::propagation::check_time;
#[cfg(target_arch = "x86_64")]
use crate::propagation::splitting::derivatives::states_with_derivatives;
use crate::propagation::splitting::require_tangent_maps;
use crate::propagation::{AveragedMotion, Motion, SymmetricMotion, TorusMotion, UniformMotion};

/// States at samples, and their derivatives. A state has nine components, those of `n`, `L` and `e_x`. Those of `e_x` mean something only if the plan
/// carries it.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// A row for each time, a column for each component.
    pub values: DMatrix<f64>,
    /// For each time a matrix with a row for each component and a column for each parameter of the plan.
    pub jacobians: Vec<DMatrix<f64>>,
}

/// Number of components of a state.
const COMPONENTS: usize = 9;

/// States at `times` and their derivatives with respect to exactly the [`derivatives`](Plan::derivatives) of a plan.
///
/// The method of the plan is used throughout. By splitting, one motion with the tangent map of each of its flows gives the derivatives with respect
/// to up to sixteen parameters at once. Values and derivatives then belong to one numerical motion, computed
/// to the tolerance of the plan, relative to the largest derivative. On the torus, values come from the Fourier series, and a forward dual for each
/// parameter follows one flow of less than a turn of its angles. With the other
/// methods a forward dual follows the motion for each parameter; steps of a series are chosen from real parts alone, and the error of its derivatives
/// can be some hundred times that of the motion.
///
/// # Errors
/// As for the motion; [`Error::Domain`] for times outside its span; [`Error::Unsupported`] for derivatives by splitting on a processor without
/// vectors of four doubles, for which no plan chooses splitting.
pub fn gradient(plan: &Plan, start: &Parameters<f64>, times: &[f64]) -> Result<Gradient, Error> {
    let in_parts: Vec<[f64; 2]> = times.iter().map(|&t| [t, 0.0]).collect();
    gradient_in_parts(plan, start, &in_parts)
}

/// As [`gradient`], at times that are sums of two doubles. The averaged motion and the motion on the torus use both: after 1e10 turns a double does
/// not resolve the phase of a body within its turn. Other motions use the sum.
///
/// # Errors
/// As for [`gradient`].
pub(crate) fn gradient_in_parts(plan: &Plan, start: &Parameters<f64>, times: &[[f64; 2]]) -> Result<Gradient, Error> {
    let count = plan.derivatives.len();
    let mut found = Gradient {
        values: DMatrix::zeros(times.len(), COMPONENTS),
        jacobians: vec![DMatrix::zeros(COMPONENTS, count); times.len()],
    };
    if times.is_empty() {
        return Ok(found);
    }
    if count == 0 {
        found.values = values(plan, start, times)?;
        return Ok(found);
    }
    let seeded = plan.derivatives.iter().map(|parameter| start.seeded(*parameter).problem());
    let seeded: Vec<Problem<Dual64>> = seeded.collect::<Result<_, Error>>()?;
    let mut write = |row: usize, index: usize, state: &BodyState<Dual64>| {
        for (column, value) in state.vectors().iter().flatten().enumerate() {
            found.values[(row, column)] = value.re;
            found.jacobians[row][(column, index)] = value.eps;
        }
    };
    if plan.method == Some(Method::Splitting) {
        require_tangent_maps()?;
        let sums: Vec<f64> = times.iter().map(|t| t[0] + t[1]).collect();
        for (row, states) in states_by_splitting(plan, &seeded, &sums)?.iter().enumerate() {
            for (index, state) in states.iter().enumerate() {
                write(row, index, state);
            }
        }
        return Ok(found);
    }
    let torus = if plan.method == Some(Method::Torus) {
        Some(TorusMotion::new(&start.problem()?, plan.span, plan.tolerance)?)
    } else {
        None
    };
    for (index, seeded) in seeded.iter().enumerate() {
        let state_at = match &torus {
            Some(torus) => Box::new(torus.states_by(seeded)?),
            None => seeded_motion(plan, seeded)?,
        };
        for (row, &t) in times.iter().enumerate() {
            write(row, index, &state_at(t)?);
        }
    }
    if plan.method == Some(Method::Averaged) {
        // Derivatives treat nearly equal eigenvalues as equal; values do not.
        found.values = values(plan, start, times)?;
    }
    Ok(found)
}

fn values(plan: &Plan, start: &Parameters<f64>, times: &[[f64; 2]]) -> Result<DMatrix<f64>, Error> {
    let mut found = DMatrix::zeros(times.len(), COMPONENTS);
    let problem = start.problem()?;
    let states = if plan.state == State::Orientation {
        states(&plan.motion(&problem)?, times)
    } else {
        states(&plan.motion(&problem.reduced())?, times)
    };
    for (row, state) in states?.iter().enumerate() {
        found.row_mut(row).iter_mut().zip(state.vectors().iter().flatten()).for_each(|(value, here)| *value = *here);
    }
    Ok(found)
}

/// The states of a motion; `e_x` is zero where it is not carried.
fn states<M: Motion<f64>>(motion: &M, times: &[[f64; 2]]) -> Result<Vec<BodyState<f64>>, Error> {
    times.iter().map(|&t| Ok(BodyState::from_vectors(motion.state_in_parts(t)?.vectors()))).collect()
}

/// The state at each time as a function of each parameter, by splitting.
#[cfg(target_arch = "x86_64")]
fn states_by_splitting(
    plan: &Plan,
    seeded: &[Problem<Dual64>],
    times: &[f64],
) -> Result<Vec<Vec<BodyState<Dual64>>>, Error> {
    let (first, _) = plan.span;
    times.iter().try_for_each(|&t| check_time(plan.span, t))?;
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|&a, &b| (times[a] - first).abs().total_cmp(&(times[b] - first).abs()));
    let sorted: Vec<f64> = order.iter().map(|&place| times[place]).collect();
    let found = if plan.state == State::Orientation {
        states_with_derivatives(seeded, first, &sorted, plan.tolerance)?
    } else {
        let reduced: Vec<_> = seeded.iter().map(Problem::reduced).collect();
        states_with_derivatives(&reduced, first, &sorted, plan.tolerance)?
    };
    let mut states = vec![Vec::new(); times.len()];
    for (place, state) in
        order.into_iter().zip(found.expect("the processor was asked, and there are parameters and times"))
    {
        states[place] = state;
    }
    Ok(states)
}

#[cfg(not(target_arch = "x86_64"))]
fn states_by_splitting(_: &Plan, _: &[Problem<Dual64>], _: &[f64]) -> Result<Vec<Vec<BodyState<Dual64>>>, Error> {
    unreachable!("no other processor has the tangent maps")
}

type StateAt<'a> = Box<dyn Fn([f64; 2]) -> Result<BodyState<Dual64>, Error> + 'a>;

/// The motion of a plan for duals, by any method except splitting and the series on the torus.
fn seeded_motion(plan: &Plan, problem: &Problem<Dual64>) -> Result<StateAt<'static>, Error> {
    fn states(motion: impl Motion<Dual64> + 'static) -> StateAt<'static> {
        Box::new(move |t| Ok(BodyState::from_vectors(motion.state_in_parts(t)?.vectors())))
    }
    let span = plan.span;
    Ok(match plan.method {
        Some(Method::Free) => states(UniformMotion::free(problem, span)),
        Some(Method::Symmetric) => states(SymmetricMotion::new(problem, span)?),
        Some(Method::Averaged) => {
            let frame = principal_frame_along(problem.coefficients())?;
            states(AveragedMotion::in_frame(problem, span, frame)?)
        }
        _ if plan.state == State::Orientation => states(problem.taylor(span, plan.tolerance)?),
        _ => states(problem.reduced().taylor(span, plan.tolerance)?),
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::dynamics::fixture::{ANGLES, RATES, STAR, tensor};
    use crate::euler_angles::EulerRates;
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::parameters::Parameter;
    use crate::plan::{Output, Request};
    use crate::solutions::perturbation::Precession;
    use crate::solutions::steady::steady_precession_rate;

    /// The components of `n` at a time.
    fn axis_of(values: &DMatrix<f64>, row: usize) -> Vector3<f64> {
        values.fixed_view::<1, 3>(row, 0).transpose()
    }

    fn start(s: [f64; 3]) -> Parameters<f64> {
        Parameters::new(STAR, tensor(s), ANGLES, RATES)
    }

    fn plan(start: &Parameters<f64>, method: Method, span: (f64, f64), tolerance: f64) -> Plan {
        let derivatives = vec![Parameter::Beta, Parameter::ConstantC];
        let request = Request::new(&[Output::SymmetryAxis], span, 3, tolerance);
        let request = Request { method: Some(method), derivatives, ..request };
        start.problem().unwrap().plan(&request).unwrap()
    }

    /// Whether the method was requested or chosen, with and without derivatives: the values are those of the motion of that name, to the last
    /// bit if it is the same motion (the one with tangent maps has other steps).
    #[test]
    fn values_and_derivatives_go_by_the_method_of_the_plan() {
        let start = start([0.2, 0.1, -0.3]);
        let times = [7.0, 19.0];
        for forced in [true, false] {
            let by = |method, derivatives: bool| {
                let mut plan = Plan { forced, ..plan(&start, method, (0.0, 20.0), 1e-5) };
                plan.derivatives.truncate(if derivatives { 2 } else { 0 });
                gradient(&plan, &start, &times)
            };
            for (method, derivatives) in [(Method::Taylor, true), (Method::Taylor, false), (Method::Splitting, false)] {
                let plan = plan(&start, method, (0.0, 20.0), 1e-5);
                let motion = plan.motion(&start.problem().unwrap().reduced()).unwrap();
                let found = by(method, derivatives).unwrap().values;
                for (row, t) in times.into_iter().enumerate() {
                    let off = (axis_of(&found, row) - motion.axis_state(t).unwrap().axis).amax();
                    // Duals compute the series without vectors of doubles: different steps of the same accuracy.
                    assert!(off <= if derivatives { 1e-6 } else { 0.0 }, "{method:?}, {derivatives}: {off}");
                }
            }
            match (by(Method::Splitting, true), require_tangent_maps()) {
                (Ok(splitting), Ok(())) => assert_ne!(by(Method::Taylor, true).unwrap(), splitting),
                (found, refused) => assert_eq!(found.err(), refused.err()),
            }
        }
    }

    /// A plan that is free to choose does not say Taylor and then use splitting. Over long spans derivatives come from the
    /// torus.
    #[test]
    fn derivatives_are_planned_by_what_makes_them() {
        let start = start([0.2, 0.1, -0.3]);
        let method = |derivatives: &[Parameter], end: f64| {
            let request = Request::new(&[Output::SymmetryAxis], (0.0, end), 3, 1e-11);
            let request = Request { derivatives: derivatives.to_vec(), ..request };
            start.problem().unwrap().plan(&request).unwrap().method
        };
        assert_eq!(method(&[], 20.0), Some(Method::Taylor));
        let with_maps = if require_tangent_maps().is_ok() { Method::Splitting } else { Method::Taylor };
        for count in [1, 3, 15] {
            assert_eq!(method(&Parameter::OF_MOTION[..count], 20.0), Some(with_maps), "{count}");
            assert_eq!(method(&Parameter::OF_MOTION[..count], 1e6), Some(Method::Torus), "{count}");
        }
    }

    /// Both parts of a time count: after 1e15 t_c one double does not resolve the phase of a body within its turn.
    #[test]
    fn derivatives_on_the_torus_are_at_both_parts_of_a_time() {
        let start = start([0.2, 0.1, -0.3]);
        let plan = plan(&start, Method::Torus, (0.0, 1e15), 1e-12);
        let at = |t: [f64; 2]| gradient_in_parts(&plan, &start, &[t]).unwrap();
        let [a, b, same] = [[8e14, 0.0], [8e14, 0.03], [8e14 - 0.5, 0.53]].map(at);
        assert!((axis_of(&a.values, 0) - axis_of(&b.values, 0)).amax() > 1e-3);
        assert!((axis_of(&b.values, 0) - axis_of(&same.values, 0)).amax() < 1e-12);
        let [b, same] = [&b, &same].map(|found| found.jacobians[0].rows(0, 3));
        assert!((b - same).amax() < 1e-12 * b.amax());
        let without = Plan { derivatives: Vec::new(), ..plan.clone() };
        let values = gradient_in_parts(&without, &start, &[[8e14, 0.0]]).unwrap().values;
        assert_eq!(axis_of(&values, 0), axis_of(&a.values, 0));
    }

    /// Steady precession about the axis of a symmetric tensor is not a free rotation.
    #[test]
    fn values_of_a_steady_precession_are_those_of_its_motion() {
        let mut start = start([0.2, 0.2, -0.4]);
        let coefficients = PrincipalCoefficients::new([0.2, 0.2, -0.4]);
        let (spin, beta) = (1.5, start.angles.beta);
        let rate = steady_precession_rate(Precession::Twofold, &start.spheroid, &coefficients, spin, beta).unwrap();
        let rates = EulerRates { alpha: rate, beta: 0.0, gamma: spin - rate * beta.cos() };
        start = Parameters::new(start.spheroid, start.coefficients, start.angles, rates);
        let request =
            Request { method: Some(Method::Steady), ..Request::new(&[Output::SymmetryAxis], (0.0, 20.0), 3, 1e-9) };
        let plan = start.problem().unwrap().plan(&request).unwrap();
        let found = gradient(&plan, &start, &[17.0]).unwrap().values;
        let expected = UniformMotion::steady(&start.problem().unwrap(), (0.0, 20.0)).unwrap();
        assert_eq!(axis_of(&found, 0), expected.axis_state(17.0).unwrap().axis);
        let free = UniformMotion::free(&start.problem().unwrap(), (0.0, 20.0));
        assert!((free.axis_state(17.0).unwrap().axis - axis_of(&found, 0)).amax() > 0.1);
    }

    #[test]
    fn times_may_come_in_any_order() {
        let start = start([0.2, 0.1, -0.3]);
        let plan = plan(&start, Method::Splitting, (20.0, -10.0), 1e-5);
        let at = |times: &[f64]| gradient(&plan, &start, times).unwrap();
        let (mixed, ordered) = (at(&[-8.0, 15.0, 3.0]), at(&[15.0, 3.0, -8.0]));
        for (place, ordered_place) in [(0, 2), (1, 0), (2, 1)] {
            assert_eq!(mixed.values.row(place), ordered.values.row(ordered_place));
            assert_eq!(mixed.jacobians[place], ordered.jacobians[ordered_place]);
        }
    }

    /// Derivatives of the averaged motion treat nearly equal eigenvalues as equal.
    #[test]
    fn values_of_the_mean_motion_are_those_without_derivatives() {
        let start = start([2e-6, -1e-6 + 1.2e-14, -1e-6 - 1.2e-14]);
        let with_derivatives = plan(&start, Method::Averaged, (0.0, 1e6), 1e-2);
        let without = Plan { derivatives: Vec::new(), ..with_derivatives.clone() };
        let values = |plan: &Plan| gradient(plan, &start, &[3e5, 1e6]).unwrap().values;
        assert_eq!(values(&with_derivatives), values(&without));
    }
}
