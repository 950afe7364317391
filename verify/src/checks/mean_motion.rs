//! The mean motion in closed form: its Hamiltonian and generator by duals, its top by integration, the motion against the numerical one.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use num_dual::Dual64;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::{Motion, propagate};
use twofold::scalar::length;
use twofold::solutions::mean::{MeanMotion, MeanOrder, Top, generator, generator_slopes, mean_potential};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest, largest_component};
use crate::fit::slope;
use crate::random::Random;
use crate::reference::reference_motion;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "mean-generator-slopes",
            kind: Kind::Autodiff,
            equations: &[25],
            statement: "the slopes of the generator of the mean motion by n and L are its automatic derivatives",
            figure: "largest difference / (C I^xx |s| / G), 200 random states",
            bound: Bound::AtMost(1e-14),
            reason: "some thirty roundings",
            measure: slopes_of_generator,
        },
        Check {
            id: "mean-generator-bracket",
            kind: Kind::Autodiff,
            equations: &[25],
            statement: "the bracket of the kinetic energy with the generator is the part of the potential that depends on the fast angle",
            figure: "largest |{L.L / (2 I^xx), W} + V - <V>| / (C |s|), 200 random states",
            bound: Bound::AtMost(1e-14),
            reason: "some thirty roundings",
            measure: bracket_of_generator,
        },
        Check {
            id: "mean-hamiltonian-second-order",
            kind: Kind::Autodiff,
            equations: &[25],
            statement: "the closed form of the second order of the mean Hamiltonian is half the average of {V + <V>, W} over the fast angle, by duals at nine angles",
            figure: "largest difference / (C^2 I^xx |s|^2 / G^2), 200 random states",
            bound: Bound::AtMost(1e-13),
            reason: "nine brackets of some hundred roundings",
            measure: second_order,
        },
        Check {
            id: "mean-top",
            kind: Kind::Oracle,
            equations: &[32],
            statement: "the direction, the frame that it carries along and the integrals of its squares, by theta functions, are those of an integration: any order of the principal values, equal ones, on and near every axis and on the separatrix",
            figure: "largest difference, of the integrals times the rate of the phase, 120 random tops over 10 units of time",
            bound: Bound::AtMost(2e-10),
            reason: "steps of 0.004 of the classical Runge-Kutta method: 0.004^4 / 120 times 10 is 2e-11, the integrals by Simpson's rule alike",
            measure: tops,
        },
        Check {
            id: "mean-motion-first-order",
            kind: Kind::Regime,
            equations: &[25, 57],
            statement: "with tp-II's geometry and s scaled by k from 1e-1 to 1e-3 n, L and e_x of the first-order mean motion are off by at most 0.03 k over 30/k t_c",
            figure: "largest error of a component of n, L or e_x over k",
            bound: Bound::AtMost(0.03),
            reason: "asked of it: the periodic part of second order, and the rates of second order over a time 1/k",
            measure: || tp_2(MeanOrder::First).map(|(measured, _)| measured),
        },
        Check {
            id: "mean-motion-second-order",
            kind: Kind::Regime,
            equations: &[25, 57],
            statement: "to second order the error is at least 20 times smaller than to first at k = 0.1",
            figure: "error of second order / error of first, n, L and e_x, k = 0.1",
            bound: Bound::AtMost(0.05),
            reason: "one power of C |s| I^xx / G^2 more, 0.003",
            measure: gain_of_second_order,
        },
        Check {
            id: "mean-motion-slopes",
            kind: Kind::Regime,
            equations: &[25, 57],
            statement: "the errors of the first and second order of the mean motion fall with the first and second power of s over times 1/s",
            figure: "largest |measured slope - order|, k from 1e-1 to 1e-3",
            bound: Bound::AtMost(0.1),
            reason: "corrections of relative order k",
            measure: slopes_of_errors,
        },
        Check {
            id: "mean-motion-regular",
            kind: Kind::Regime,
            equations: &[25, 26],
            statement: "the second-order mean motion holds for random geometries, single precession with n on L, c^2 = 1/3 and tensors with two equal values among them",
            figure: "largest error of n, L / G or e_x over x^2 (1 + x G t / I^xx), x = C (s_max - s_min) I^xx / G^2, away from the separatrix",
            bound: Bound::AtMost(6.0),
            reason: "the periodic part of second order and rates of third, with coefficients of order one; 3.3 was seen",
            measure: random_geometries,
        },
    ]
}

fn text(error: twofold::Error) -> String {
    error.to_string()
}

struct State {
    body: RigidSpheroid<f64>,
    s: Vector3<f64>,
    n: Vector3<f64>,
    momentum: Vector3<f64>,
}

fn random_state(random: &mut Random) -> State {
    let s = Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
    let s = s.map(|value| value - s.mean());
    let mut direction = || {
        let z: f64 = random.within(-1.0, 1.0);
        let (sin, cos) = random.within(0.0, TAU).sin_cos();
        let rho = (1.0 - z * z).sqrt();
        Vector3::new(rho * cos, rho * sin, z)
    };
    let (n, l) = (direction(), direction());
    let momentum = l * random.within(0.5, 3.0);
    let mut body = RigidSpheroid::in_units_of_tc(1.1);
    body.inertia_xx = random.within(0.5, 2.0);
    body.constant_c = random.within(0.5, 2.0);
    State { body, s, n, momentum }
}

type Function = fn(&State, &Vector3<Dual64>, &Vector3<Dual64>) -> Dual64;

fn lifted(body: &RigidSpheroid<f64>) -> RigidSpheroid<Dual64> {
    RigidSpheroid {
        inertia_xx: Dual64::from_re(body.inertia_xx),
        inertia_zz: Dual64::from_re(body.inertia_zz),
        constant_c: Dual64::from_re(body.constant_c),
    }
}

/// Slopes by `n` and `L`.
fn slopes_of(f: Function, state: &State) -> [Vector3<f64>; 2] {
    let at = |place: usize, i: usize| {
        let mut vectors = [state.n, state.momentum].map(|v| v.map(Dual64::from_re));
        vectors[place][i].eps = 1.0;
        f(state, &vectors[0], &vectors[1]).eps
    };
    [0, 1].map(|place| Vector3::new(at(place, 0), at(place, 1), at(place, 2)))
}

/// `{f, g} = L.(f_L x g_L) + n.(f_L x g_n + f_n x g_L)`.
fn bracket(f: Function, g: Function, state: &State) -> f64 {
    let [f_n, f_l] = slopes_of(f, state);
    let [g_n, g_l] = slopes_of(g, state);
    state.momentum.dot(&f_l.cross(&g_l)) + state.n.dot(&(f_l.cross(&g_n) + f_n.cross(&g_l)))
}

fn dual(v: &Vector3<f64>) -> Vector3<Dual64> {
    v.map(Dual64::from_re)
}

fn kinetic(state: &State, _: &Vector3<Dual64>, momentum: &Vector3<Dual64>) -> Dual64 {
    momentum.dot(momentum) / (2.0 * state.body.inertia_xx)
}

fn potential(state: &State, n: &Vector3<Dual64>, _: &Vector3<Dual64>) -> Dual64 {
    n.dot(&dual(&state.s).component_mul(n)) * state.body.constant_c
}

fn mean_of_potential(state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>) -> Dual64 {
    let size = length(momentum);
    let l = momentum / size;
    let c = n.dot(&l);
    mean_potential(&lifted(&state.body), &dual(&state.s), size, c, &l, MeanOrder::First)
}

fn of_generator(state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>) -> Dual64 {
    generator(&lifted(&state.body), &dual(&state.s), n, momentum)
}

fn at_random(measure: impl Fn(&State) -> f64) -> Result<Measured, String> {
    let mut random = Random::with_seed(57);
    let mut worst = Worst::default();
    for case in 0..200 {
        let state = random_state(&mut random);
        worst.see(measure(&state), || format!("case {case} of seed 57"));
    }
    worst.finish()
}

fn slopes_of_generator() -> Result<Measured, String> {
    at_random(|state| {
        let State { body, s, n, momentum } = state;
        let closed = generator_slopes(body, s, n, momentum);
        let by_duals = slopes_of(of_generator, state);
        let size = momentum.norm();
        let unit = body.constant_c * body.inertia_xx * s.norm() / size;
        let [by_axis, by_momentum] = [0, 1].map(|i| largest_component(&(closed[i] - by_duals[i])));
        largest([by_axis, by_momentum * size]) / unit
    })
}

fn bracket_of_generator() -> Result<Measured, String> {
    at_random(|state| {
        let value = |f: Function| f(state, &dual(&state.n), &dual(&state.momentum)).re;
        let periodic = value(potential) - value(mean_of_potential);
        (bracket(kinetic, of_generator, state) + periodic).abs() / (state.body.constant_c * state.s.norm())
    })
}

fn second_order() -> Result<Measured, String> {
    at_random(|state| {
        let State { body, s, n, momentum } = state;
        let size = momentum.norm();
        let l = momentum / size;
        let mut sum = 0.0;
        for k in 0..9 {
            let turn = Rotation3::from_axis_angle(&Unit::new_normalize(l), TAU * f64::from(k) / 9.0);
            let turned = State { body: *body, s: *s, n: turn * n, momentum: *momentum };
            sum += bracket(potential, of_generator, &turned) + bracket(mean_of_potential, of_generator, &turned);
        }
        let c = n.dot(&l);
        let order = |order| mean_potential(body, s, size, c, &l, order);
        let unit = body.constant_c.powi(2) * body.inertia_xx * s.norm_squared() / (size * size);
        (order(MeanOrder::Second) - order(MeanOrder::First) - sum / 18.0).abs() / unit
    })
}

/// Direction, frame and integrals of the squares after 10 units of time.
fn integrated(k: &Vector3<f64>, l: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>, Vector3<f64>) {
    let rates = |l: &Vector3<f64>, frame: &Matrix3<f64>| {
        let w = k.component_mul(l);
        (w.cross(l), w.cross_matrix() * frame)
    };
    let step = 0.004;
    let (mut l, mut frame, mut integral) = (l, Matrix3::identity(), Vector3::zeros());
    let half = |l: Vector3<f64>, frame: Matrix3<f64>, step: f64| {
        let (a, p) = rates(&l, &frame);
        let (b, q) = rates(&(l + a * step / 2.0), &(frame + p * step / 2.0));
        let (c, r) = rates(&(l + b * step / 2.0), &(frame + q * step / 2.0));
        let (d, s) = rates(&(l + c * step), &(frame + r * step));
        (l + (a + b * 2.0 + c * 2.0 + d) * step / 6.0, frame + (p + q * 2.0 + r * 2.0 + s) * step / 6.0)
    };
    for _ in 0..1250 {
        let (middle, middle_frame) = half(l, frame, step);
        let (end, end_frame) = half(middle, middle_frame, step);
        let square = |v: &Vector3<f64>| v.component_mul(v);
        integral += (square(&l) + square(&middle) * 4.0 + square(&end)) * step / 3.0;
        (l, frame) = (end, end_frame);
    }
    (l, frame, integral)
}

fn tops() -> Result<Measured, String> {
    let mut random = Random::with_seed(58);
    let mut worst = Worst::default();
    for case in 0..120 {
        let mut any = || random.within(-1.0, 1.0);
        let mut k = Vector3::new(any(), any(), any());
        let mut l = Vector3::new(any(), any(), any());
        match case % 6 {
            0 => k.y = k.x,
            1 => k.z = k.y,
            2 => k.y = k.x + 1e-9 * k.z,
            3 => k = Vector3::from_element(k.x),
            _ => {}
        }
        match case % 7 {
            0 => l = Vector3::z(),
            1 => l = Vector3::new(1e-7 * l.x, 1e-9 * l.y, -1.0),
            2 => l = Vector3::new(1e-3 * l.x, 1.0, 1e-3 * l.z),
            3 => l.z = 0.0,
            // On the separatrix.
            4 => (k, l.z) = (Vector3::new(k.x, 0.0, -k.x), l.x),
            _ => {}
        }
        let l = l.normalize();
        let top = Top::new(k.into(), &l);
        let time = 10.0;
        let (start, end) = (top.at(top.start()), top.at(top.start() + top.rates().slow * time));
        let about =
            top.rates().about * time + end.turned[1].atan2(end.turned[0]) - start.turned[1].atan2(start.turned[0]);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), about);
        let frame = end.frame * turn * start.frame.transpose();
        // What enters a phase is this times rates as small as the slow one.
        let squares = top.mean_squares() * time + top.squares(end.integral - start.integral);
        let (direction, by_steps, integral) = integrated(&k, l);
        let off = largest([
            (frame - by_steps).amax(),
            (end.frame.column(2) - direction).amax(),
            (squares - integral).amax() * top.rates().slow.abs().min(1.0),
        ]);
        worst.see(off, || format!("case {case} of seed 58: k = {k:?}, l = {l:?}"));
    }
    worst.finish()
}

const SCALES: [f64; 5] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3];

/// Largest error of n, L and e_x over 30/k t_c.
fn error_of_tp_2(order: MeanOrder, k: f64) -> Result<f64, String> {
    let scene = reference_motion("tp-2");
    let values = [scene.coefficients.xx, scene.coefficients.yy, scene.coefficients.zz].map(|value| value * k);
    let coefficients = PrincipalCoefficients::new(values);
    let initial = scene.initial();
    let exact = propagate(&scene.spheroid, &coefficients.tensor(), &initial, (0.0, 30.0 / k), 1e-13).map_err(text)?;
    let mean = MeanMotion::new(&scene.spheroid, &coefficients, &initial, order).map_err(text)?;
    let mut most = 0.0;
    for i in 0..=200 {
        let t = 30.0 / k * f64::from(i) / 200.0;
        most = largest([most, difference(&mean.state(t), &exact.state(t).map_err(text)?)]);
    }
    Ok(most)
}

fn difference(a: &BodyState<f64>, b: &BodyState<f64>) -> f64 {
    let axis = largest_component(&(a.axis - b.axis));
    let momentum = largest_component(&((a.momentum - b.momentum) / b.momentum.norm()));
    largest([axis, momentum, largest_component(&(a.equatorial_axis - b.equatorial_axis))])
}

fn tp_2(order: MeanOrder) -> Result<(Measured, Vec<(f64, f64)>), String> {
    let mut worst = Worst::default();
    let mut errors = Vec::new();
    for k in SCALES {
        let all = error_of_tp_2(order, k)?;
        worst.see(all / k, || format!("k = {k}"));
        errors.push((k.log10(), all.log10()));
    }
    Ok((worst.finish()?, errors))
}

fn gain_of_second_order() -> Result<Measured, String> {
    let mut worst = Worst::default();
    let ratio = error_of_tp_2(MeanOrder::Second, 0.1)? / error_of_tp_2(MeanOrder::First, 0.1)?;
    worst.see(ratio, || "k = 0.1".to_owned());
    worst.finish()
}

fn slopes_of_errors() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (order, expected) in [(MeanOrder::First, 1.0), (MeanOrder::Second, 2.0)] {
        let fit = slope(&tp_2(order)?.1)?;
        worst.see((fit.value - expected).abs(), || format!("{order:?}: {:.3} +- {:.3}", fit.value, fit.error));
    }
    worst.finish()
}

fn random_geometries() -> Result<Measured, String> {
    let mut random = Random::with_seed(59);
    let mut worst = Worst::default();
    let mut followed = 0;
    for case in 0..40 {
        let State { mut s, n, momentum, .. } = random_state(&mut random);
        s *= 3e-3;
        match case % 4 {
            0 => s.y = s.x,
            1 => s.z = s.y,
            _ => {}
        }
        let body = RigidSpheroid::in_units_of_tc(random.within(0.5, 1.9));
        let l = momentum.normalize();
        let across = (n - l * n.dot(&l)).normalize();
        let n = match case % 5 {
            0 => l,
            1 => l * (1.0 / 3.0f64).sqrt() + across * (2.0 / 3.0f64).sqrt(),
            2 => (l + across * 1e-3).normalize(),
            _ => n,
        };
        let coefficients = PrincipalCoefficients::new(s.into());
        // Near the separatrix small differences grow.
        let mut sorted = [s.x, s.y, s.z];
        sorted.sort_by(f64::total_cmp);
        let distance = (l.dot(&s.component_mul(&l)) - sorted[1]).abs() / (sorted[2] - sorted[0]);
        if distance < 0.1 {
            continue;
        }
        followed += 1;
        let equatorial_axis = n.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
        let initial = BodyState { axis: n, momentum, equatorial_axis };
        let mean = MeanMotion::new(&body, &coefficients, &initial, MeanOrder::Second).map_err(text)?;
        let (x, rate) = (mean.relative_strength(), momentum.norm() / body.inertia_xx);
        let end = 3.0 / (x * rate);
        let exact = propagate(&body, &coefficients.tensor(), &initial, (0.0, end), 1e-13).map_err(text)?;
        for i in 0..=20 {
            let t = (end * f64::from(i) / 20.0).min(end);
            let off = difference(&mean.state(t), &exact.state(t).map_err(text)?);
            let allowed = x * x * (1.0 + x * rate * t);
            worst.see(off / allowed, || {
                format!("case {case} of seed 59 at t = {t}: s = {s:?}, n = {n:?}, L = {momentum:?}")
            });
        }
    }
    if followed < 25 {
        return Err(format!("only {followed} of 40 motions are away from the separatrix"));
    }
    worst.finish()
}
