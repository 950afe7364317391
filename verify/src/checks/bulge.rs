//! Stars with a centrifugal bulge: the averaged motion compared with integration of the equations of motion.

use twofold::dynamics::bulge::{bulge_potential, bulge_turning};
use twofold::observables::pulsar::PulsarClock;
use twofold::propagation::PhasedMotion;

use crate::averaged_scenes::{AveragedScene, direction};
use crate::prelude::*;
use crate::second_integrator::{regular_motion, regular_states};

checks! {
    /// the angular velocity due to a bulge is the slope of its energy by L, and the torque on L the slope under a rotation of L
    Autodiff "bulge-slopes" []: slopes;
    AtMost(1e-15) "largest difference / (|b| |s| |L|), and over |L| of the torque, 200 random tensors and L";
    because "some ten roundings";
    /// a bulge changes neither |L| nor the angle between n and L: without a rigid deformation (C = 0) the averaged motion is exact, at any strength
    /// of it
    Oracle "bulge-alone" []: alone;
    AtMost(3e-11) "largest difference of n, e_x and L / |L|, 40 random motions up to 300 rad, strength of the bulge up to 0.19";
    because "the other method's tolerance of 1e-14 in some ten steps a radian grows with the phase, to 300 times 1e-13";
    /// with tp-II's geometry and the bulge of a fluid, s scaled by k, the errors of both orders over 30/k t_c fall with the first and second power of k
    Oracle "bulge-orders" []: orders;
    AtMost(0.1) "largest |measured slope - order|, k from 1e-1 to 3e-3";
    because "corrections of relative order k";
    /// the error estimate of the averaged motion is not below its error, also for a bulge up to 1e6 times as strong as the rigid deformation
    Property "bulge-estimate" []: estimate;
    AtMost(1.0) "largest (true error - 3e-11) / estimate, 300 random motions up to 300 rad, both orders";
    because "an estimate below the true error is wrong; 3e-11 is the error of the integration";
    /// for n along L the averaged L precesses at the rate behind the paper's bounds, with the sum of both C: for a fluid with I / C = 4 / Omega^2
    Oracle "bulge-bounds" [32, 41]: bounds;
    AtMost(3e-8) "largest relative difference of the rate about the axis of s, C from 0 to 30 times that of the bulge, s_max - s_min = 3e-9";
    because "corrections of the relative strength of the torque, 31/4 of 3e-9, times a number of order one";
    /// at the pulse edges of a star with a bulge the line of sight lies on the rim of the beam in the integrated motion
    Oracle "bulge-edges" []: edges;
    AtMost(1e-10) "largest |m.n - cos rho|, at least 30 edges in 400 rad, strength of the bulge 0.1";
    because "the other method's tolerance 1e-14 per step grows with the phase, to some 1e-11, and n turns for 400 rad at rates below one";
}

const ORDERS: [AveragingOrder; 2] = [AveragingOrder::First, AveragingOrder::Second];

fn slopes() -> Result<Measured, String> {
    worst_of_draws(83, 200, |random| {
        let s = Matrix3::from_fn(|_, _| random.within(-1.0, 1.0));
        let s = s + s.transpose();
        let (momentum, b) = (direction(random) * random.within(0.5, 3.0), random.within(-1.0, 1.0));
        let lifted = s.map(Dual64::from_re);
        let slope = |way: &Vector3<f64>| {
            let moved = momentum.zip_map(way, Dual64::new);
            bulge_potential(Dual64::from_re(b), &lifted, &moved).eps
        };
        let basis = [Vector3::x(), Vector3::y(), Vector3::z()];
        let turning = bulge_turning(b, &s, &momentum);
        let unit = b.abs() * s.norm() * momentum.norm();
        let by_slopes = Vector3::from(basis.map(|axis| slope(&axis)));
        // A small rotation changes L by axis x L; the torque is minus the slope of the energy.
        let by_rotation = Vector3::from(basis.map(|axis| slope(&momentum.cross(&axis))));
        let off = [turning - by_slopes, (turning.cross(&momentum) - by_rotation) / momentum.norm()];
        Ok(largest(off.map(|v| largest_component(&v))) / unit)
    })
}

/// Random scene `number` in which a bulge of either sign has all of the strength, or all but a part as small as 1e-6.
fn with_bulge(number: u64, all: bool) -> Result<AveragedScene, String> {
    let scene = AveragedScene::draw(29, number, 300.0);
    let mut random = Random::with_seed(31 + number);
    let rigid = if all { 0.0 } else { random.within(1e-6_f64.ln(), 0.0).exp() };
    let sign = if random.word().is_multiple_of(3) { -1.0 } else { 1.0 };
    let (problem, mut body) = (&scene.problem, *scene.problem.spheroid());
    let b = sign * (1.0 - rigid) * body.constant_c.abs() / problem.initial().momentum.norm_squared();
    body.constant_c *= rigid;
    let problem = Problem::new(body, *problem.coefficients(), *problem.initial())?.with_bulge(b)?;
    Ok(AveragedScene { problem, ..scene })
}

/// Difference between the averaged motion of an order and a state.
fn difference(averaged: &AveragedSolution<f64>, t: f64, exact: &BodyState<f64>) -> f64 {
    largest_difference(&averaged.state(t), exact, exact.momentum.norm())
}

fn alone() -> Result<Measured, String> {
    worst_of(0..40, |&number| {
        let scene = with_bulge(number, true)?;
        let exact = regular_motion(&scene.problem, scene.end, 1e-14)?;
        Ok(difference(&scene.motion(AveragingOrder::Second)?, scene.end, &exact))
    })
}

fn estimate() -> Result<Measured, String> {
    worst_of(0..300, |&number| {
        let scene = with_bulge(number, false)?;
        let exact = regular_motion(&scene.problem, scene.end, 1e-14)?;
        worst_of(ORDERS, |&order| {
            let averaged = scene.motion(order)?;
            let off = difference(&averaged, scene.end, &exact);
            let estimate = averaged.error_estimate(scene.end);
            // A difference that is not a number stays one.
            let beyond = if off <= 3e-11 { 0.0 } else { off - 3e-11 };
            Ok(Measured::new(beyond / estimate, format!("{number}: {off:.1e}, estimated {estimate:.1e}")))
        })
    })
}

fn orders() -> Result<Measured, String> {
    let scene = reference_motion("tp-2");
    let (mut first, mut second) = (Vec::new(), Vec::new());
    for k in [1e-1, 3e-2, 1e-2, 3e-3] {
        let problem = Problem::new(scene.spheroid, scene.coefficients.scaled(k).tensor(), scene.initial())?;
        let problem = problem.with_bulge(0.25 / scene.spheroid.inertia_xx)?;
        let times: Vec<f64> = (1..=6).map(|i| 5.0 / k * f64::from(i)).collect();
        let exact = regular_states(&problem, &times, 1e-14)?;
        for (order, errors) in ORDERS.into_iter().zip([&mut first, &mut second]) {
            let averaged = AveragedSolution::new(&problem, order)?;
            errors.push((k, largest(times.iter().zip(&exact).map(|(t, exact)| difference(&averaged, *t, exact)))));
        }
    }
    largest_off_order([("first", 1.0, first), ("second", 2.0, second)])
}

fn bounds() -> Result<Measured, String> {
    worst_of([0.0, 0.1, 1.0, 30.0], |&ratio| {
        let (inertia, spin) = (1.3, 1.7);
        let of_bulge = inertia * spin * spin / 4.0;
        let body = RigidSpheroid { inertia_xx: 1.2, inertia_zz: inertia, constant_c: ratio * of_bulge };
        let s = Matrix3::from_diagonal(&Vector3::new(1e-9, 1e-9, -2e-9));
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let start = BodyState { axis, momentum: axis * (inertia * spin), equatorial_axis: Vector3::y() };
        let problem = Problem::new(body, s, start)?.with_bulge(0.25 / inertia)?;
        let averaged = AveragedSolution::new(&problem, AveragingOrder::Second)?;
        // L circles Z: by about a radian in this time.
        let time = 1.0 / averaged.rates().slow.abs();
        let momentum = averaged.state(time).momentum;
        let slow = momentum.y.atan2(momentum.x) / time;
        let inertia_over_c = twofold::observables::bound::fluid_inertia_over_c(spin) / (1.0 + ratio);
        // The velocity across the meridian of the axis of s is the rate about Z times the sine.
        let rate = secular_axis_rate(inertia_over_c, spin, &s, &axis).y / axis.x;
        Ok((slow / rate - 1.0).abs())
    })
}

fn edges() -> Result<Measured, String> {
    let s = Matrix3::from_diagonal(&Vector3::new(0.2, 0.05, -0.2));
    let body = RigidSpheroid { inertia_xx: 1.0, inertia_zz: 1.1, constant_c: 1e-12 };
    let axis = Vector3::new(0.3_f64.sin(), 0.0, 0.3_f64.cos());
    let start = BodyState { axis, momentum: Vector3::new(0.1, 0.5, 0.9), equatorial_axis: Vector3::y() };
    let problem = Problem::new(body, s, start)?.with_bulge(0.25)?;
    let (beam, observer) = (Beam::new(1.2, 0.4, 0.3), Observer::at(1.1, 0.2));
    let clock = PulsarClock::new(PhasedMotion::new(&problem, 400.0)?, &beam, &observer)?;
    let mut times = Vec::new();
    for k in 1..=60 {
        if let Some(pulse) = clock.pulse_near([6.5 * f64::from(k), 0.0])? {
            times.extend([-0.5, 0.5].map(|half| pulse.midpoint[0] + half * pulse.duration));
        }
    }
    if times.len() < 30 {
        return Err(format!("only {} edges", times.len()));
    }
    worst_of(times, |&t| Ok(beam.margin(&regular_motion(&problem, t, 1e-14)?, &observer.direction).abs()))
}
