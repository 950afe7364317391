//! Mean Hamiltonian and generator by duals.

use core::f64::consts::TAU;

use nalgebra::{Rotation3, Unit, Vector3};
use num_dual::Dual64;
use twofold::dynamics::RigidSpheroid;
use twofold::numerics::scalar::length;
use twofold::solutions::averaged::{
    AveragingOrder, generator, generator_slopes, mean_angular_velocity, mean_potential,
};

use super::scenes::{State, random_state};
use crate::check::{Bound, Check, Kind, Measured, Worst, largest, largest_component};
use crate::random::Random;

/// Checks of this subject.
pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "mean-generator-slopes",
            kind: Kind::Autodiff,
            equations: &[25],
            statement: "the slopes of the generator of the averaged motion by n and L are its automatic derivatives",
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
            statement: "the closed form of the second order of the mean Hamiltonian, for traceless s, is half the average of {V + <V>, W} over the fast angle, by duals at nine angles",
            figure: "largest difference / (C^2 I^xx |s|^2 / G^2), 200 random states",
            bound: Bound::AtMost(1e-13),
            reason: "nine brackets of some hundred roundings",
            measure: second_order,
        },
        Check {
            id: "mean-frame-rate",
            kind: Kind::Autodiff,
            equations: &[25],
            statement: "the rates of the frame and of l are those that the mean Hamiltonian generates: w = <H>_L, dL/dt = w x L + <H>_n x n",
            figure: "largest difference / (G / I^xx), 200 random states, both orders",
            bound: Bound::AtMost(1e-13),
            reason: "some hundred roundings",
            measure: rates_of_frame,
        },
    ]
}

type Function = fn(&State, &Vector3<Dual64>, &Vector3<Dual64>) -> Dual64;

fn lifted(body: &RigidSpheroid<f64>) -> RigidSpheroid<Dual64> {
    body.map(Dual64::from_re)
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
    mean_potential(&lifted(&state.body), &dual(&state.s), size, c, &l, AveragingOrder::First)
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
        (order(AveragingOrder::Second) - order(AveragingOrder::First) - sum / 18.0).abs() / unit
    })
}

fn to_second_order(state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>) -> Dual64 {
    of_order(state, n, momentum, AveragingOrder::Second)
}

fn to_first_order(state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>) -> Dual64 {
    of_order(state, n, momentum, AveragingOrder::First)
}

fn of_order(state: &State, n: &Vector3<Dual64>, momentum: &Vector3<Dual64>, order: AveragingOrder) -> Dual64 {
    let size = length(momentum);
    let l = momentum / size;
    let c = n.dot(&l);
    kinetic(state, n, momentum) + mean_potential(&lifted(&state.body), &dual(&state.s), size, c, &l, order)
}

fn rates_of_frame() -> Result<Measured, String> {
    at_random(|state| {
        let State { body, s, n, momentum } = state;
        let size = momentum.norm();
        let l = momentum / size;
        let orders: [(Function, AveragingOrder); 2] =
            [(to_first_order, AveragingOrder::First), (to_second_order, AveragingOrder::Second)];
        largest(orders.map(|(function, order)| {
            let [by_axis, by_momentum] = slopes_of(function, state);
            let (about_momentum, tensor, about_axis) = mean_angular_velocity(body, s, size, n.dot(&l), &l, order);
            let pull = tensor.component_mul(&l);
            let w = l * about_momentum + pull + n * about_axis;
            let direction = (by_momentum.cross(momentum) + by_axis.cross(n)) / size;
            let off = [w - by_momentum, pull.cross(&l) - direction].map(|v| largest_component(&v));
            largest(off) / (size / body.inertia_xx)
        }))
    })
}
