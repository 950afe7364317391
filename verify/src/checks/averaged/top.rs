//! The asymmetric top, compared with numerical integration.

use crate::prelude::*;
use twofold::solutions::averaged::Top;

checks! {
    /// the direction, the frame that it carries along and the integrals of its squares, by theta functions, agree with an integration: any order
    /// of the principal values, equal ones, on and near every axis and on the separatrix
    Oracle "mean-top" [32]: tops;
    AtMost(2e-10) "largest difference, of the integrals times the rate of the phase, 120 random tops over 10 units of time";
    because "steps of 0.004 of the classical Runge-Kutta method: 0.004^4 / 120 times 10 is 2e-11, and Simpson's rule for the integrals is of the \
     same order";
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
    let mut case = 0;
    worst_of_draws(58, 120, |random| {
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
            // The direction is on the separatrix.
            4 => (k, l.z) = (Vector3::new(k.x, 0.0, -k.x), l.x),
            _ => {}
        }
        case += 1;
        let l = l.normalize();
        let top = Top::new(k.into(), &l);
        let time = 10.0;
        let (start, end) = (top.at(top.start), top.at(top.start + top.rates.slow * time));
        let about =
            top.rates.about * time + end.turned[1].atan2(end.turned[0]) - start.turned[1].atan2(start.turned[0]);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), about);
        let frame = end.frame * turn * start.frame.transpose();
        // The integrals enter a phase multiplied by rates as small as the slow one.
        let squares = top.mean_squares() * time + top.squares(end.integral - start.integral);
        let (direction, by_steps, integral) = integrated(&k, l);
        Ok(largest([
            largest_component(&(frame - by_steps)),
            largest_component(&(end.frame.column(2) - direction)),
            largest_component(&(squares - integral))
                * if k.x == k.y && k.y == k.z { 1.0 } else { top.rates.slow.abs().min(1.0) },
        ]))
    })
}
