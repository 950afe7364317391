//! Fits of arrival times and clocks in cases with answers in closed form, one for each sign, factor and branch.

use std::f64::consts::TAU;

use approx::assert_relative_eq;
use twofold::Error;
use twofold::dynamics::{Problem, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::observables::Observer;
use twofold::observables::pulsar::{Beam, PulsarClock, SpinFit, pulse_train};
use twofold::propagation::PhasedMotion;

/// The phase `3.25 + 2 t + 0.05 t^2` at whole numbers from 30 on: far from time zero, and far from a straight line.
fn of_a_parabola() -> Vec<(i64, [f64; 2])> {
    (30..60).map(|number| (number, [time_on_parabola(number), 0.0])).collect()
}

fn time_on_parabola(number: i64) -> f64 {
    let wanted = number as f64 - 3.25;
    2.0 * wanted / (2.0 + (4.0 + 0.2 * wanted).sqrt())
}

#[test]
fn a_parabola_gives_back_its_coefficients() -> Result<(), Error> {
    let fit = SpinFit::new(&of_a_parabola(), 1)?;
    assert_relative_eq!(fit.phase[0] + fit.phase[1], 3.25, epsilon = 1e-12);
    assert_relative_eq!(fit.frequency[0], 2.0, epsilon = 1e-13);
    assert_relative_eq!(fit.derivatives[0], 0.1, epsilon = 1e-14);
    assert!(fit.residuals.iter().all(|late| late.abs() < 1e-13), "{:?}", fit.residuals);
    for number in [-5, 0, 3, 4, 10, 45, 1000] {
        assert_relative_eq!(fit.time_of(number)[0], time_on_parabola(number), epsilon = 1e-12, max_relative = 1e-13);
    }
    // The smallest phase, -16.75, is at t = -20.
    assert!(fit.time_of(-17)[0].is_nan());
    Ok(())
}

#[test]
fn time_may_run_against_the_numbers() -> Result<(), Error> {
    let backwards: Vec<_> = of_a_parabola().into_iter().map(|(number, [t, _])| (number, [-t, 0.0])).collect();
    let fit = SpinFit::new(&backwards, 1)?;
    assert_relative_eq!(fit.frequency[0], -2.0, epsilon = 1e-13);
    assert_relative_eq!(fit.time_of(45)[0], -time_on_parabola(45), epsilon = 1e-12);
    Ok(())
}

/// The chord goes to the farthest point, for any order of the points: by way of a near one the small numbers would be lost.
#[test]
fn the_order_of_points_makes_no_difference() -> Result<(), Error> {
    let far = |sign: f64| {
        let near = (1, [sign * 0.1000003, 0.0]);
        let (middle, last) = ((5_000_000_000, [sign * 5e8, 1e-9]), (10_000_000_000, [sign * 1e9, 0.0]));
        [
            vec![(0, [0.0; 2]), middle, last, near],
            vec![(0, [0.0; 2]), near, last, middle],
            vec![(0, [0.0; 2]), near, middle, last],
        ]
    };
    for sign in [1.0, -1.0] {
        for points in far(sign) {
            let fit = SpinFit::new(&points, 0)?;
            let sum: f64 = fit.residuals.iter().sum();
            assert!(sum.abs() < 1e-15, "residuals of a fit have no mean: {:?}", fit.residuals);
            let most = fit.residuals.iter().fold(0.0_f64, |most, late| most.max(late.abs()));
            assert!(most < 1e-6, "{:?}", fit.residuals);
            let late = |number: i64| {
                let at = points.iter().position(|&(k, _)| k == number).expect("one of the points");
                fit.residuals[at]
            };
            // The delay of the near point relative to the first one.
            assert_relative_eq!(late(1) - late(0), sign * 3e-7, epsilon = 1e-15);
        }
    }
    Ok(())
}

#[test]
fn different_times_and_numbers_are_counted() {
    let whole = |points: &[(i64, f64)]| points.iter().map(|&(k, t)| (k, [t, 0.0])).collect::<Vec<_>>();
    assert!(SpinFit::new(&whole(&[(0, 0.0), (1, 1.0), (2, 2.5)]), 1).is_ok());
    for few in [&[][..], &[(0, 0.0)], &[(3, 0.0), (3, 1.0)]] {
        assert!(SpinFit::new(&whole(few), 0).is_err(), "{few:?}");
    }
    assert!(SpinFit::new(&whole(&[(0, 0.0), (1, 1.0)]), 0).is_ok());
    // Three points with only two different times or numbers, in any order, do not determine a rate.
    assert!(SpinFit::new(&whole(&[(0, 0.0), (1, 1.0), (2, 0.0)]), 1).is_err());
    assert!(SpinFit::new(&whole(&[(0, 0.0), (1, 1.0), (0, 2.0)]), 1).is_err());
    // A time is the sum of its two parts.
    assert!(SpinFit::new(&[(0, [0.0; 2]), (1, [1.0, 0.5]), (2, [1.5, 0.0])], 1).is_err());
    assert!(SpinFit::new(&[(0, [0.0; 2]), (1, [1.0, f64::NAN])], 0).is_err());
    // Numbers that are not exact as doubles.
    let largest = 1 << 53;
    assert!(SpinFit::new(&whole(&[(0, 0.0), (largest, 1e16)]), 0).is_ok());
    assert!(SpinFit::new(&whole(&[(0, 0.0), (largest + 1, 1e16)]), 0).is_err());
    assert!(SpinFit::new(&whole(&[(0, 0.0), (-largest - 1, 1e16)]), 0).is_err());
}

fn star() -> Result<Problem<f64>, Error> {
    let angles = EulerAngles { alpha: 0.3, beta: 1.1, gamma: 0.0 };
    let rates = EulerRates { alpha: 0.9, beta: 0.0, gamma: 0.4 };
    let s = PrincipalCoefficients::new([2e-6, -1e-6, 0.5e-6]);
    Problem::from_angles(RigidSpheroid::in_units_of_tc(1.001), s.tensor(), &angles, &rates)
}

#[test]
fn the_error_of_a_clock_is_that_of_its_motion_over_the_rate_of_turns() -> Result<(), Error> {
    let (beam, observer) = (Beam::new(1.2, 0.0, 0.6), Observer::at(0.8, 0.0));
    let clock = PulsarClock::new(PhasedMotion::averaged(&star()?)?, &beam, &observer)?;
    let truncation = clock.truncation(40.0);
    assert!(truncation > 0.0);
    assert_relative_eq!(truncation, clock.motion().truncation(40.0) * clock.period() / TAU, max_relative = 1e-14);
    Ok(())
}

/// A span that ends inside a pulse.
#[test]
fn a_pulse_at_the_end_of_a_span_is_cut_there() -> Result<(), Error> {
    let (problem, beam, observer) = (star()?, Beam::new(1.2, 0.0, 0.6), Observer::at(0.8, 0.0));
    let motion = problem.taylor((0.0, 60.0), 1e-12)?;
    let whole = pulse_train(&motion, &beam, &observer.direction, (0.0, 60.0))?;
    let pulse = whole.pulses.iter().find(|pulse| pulse.is_whole()).expect("a whole pulse");
    let end = pulse.midpoint();
    for tolerance in [1e-12, 1e-4] {
        let motion = problem.taylor((0.0, end), tolerance)?;
        let train = pulse_train(&motion, &beam, &observer.direction, (0.0, end))?;
        let last = train.pulses.last().expect("the pulse");
        assert!(last.cut_at_end && last.end == end, "{last:?}");
        assert_relative_eq!(last.start, pulse.start, epsilon = 1e-3);
    }
    Ok(())
}
