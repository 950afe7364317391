//! The pulsar signal compared with the 34-digit motion: `m.n`, edges and closest approaches. Eqs. (44)-(47).

use twofold::observables::pulsar::Pulse;

use super::cases::paper_signal;
use crate::prelude::*;
use crate::reference::{ReferencePulse, reference_pulses};

checks! {
    /// m.n of the numerical motion of ten scenes, as a vector and by Eq. (47) in its Euler angles, is that of the 34-digit states
    Oracle "signal-of-reference-motion" [45, 46, 47]: signal_of_reference_motion;
    AtMost(1e-12) "largest difference of m.n, three magnetic axes and three observers, every listed time";
    because "the numerical motion agrees with those states within 1e-12";
    /// the edges of the first 160 whole pulses of tp-I and of tp-II each are the roots along a 34-digit motion, with no pulse more or less
    Oracle "pulse-edges-reference" [44, 47]: || {
        worst_pulse(|pulse, _, expected| {
            largest([(pulse.start - expected.start).abs(), (pulse.end - expected.end).abs()])
        })
    };
    AtMost(1e-12) "largest error of an edge [t_c]; infinite for another number of pulses";
    because "the motion's rounding after 1,500 rad, some 1e-14, over the rate of m.n, 0.04 to 0.5 per t_c";
    /// the times at which m.n is largest in these pulses are those along the 34-digit motion
    Oracle "closest-approach-reference" [44, 47]: || {
        worst_pulse(|_, arrival, expected| (arrival.closest_approach - expected.closest_approach).abs())
    };
    AtMost(1e-12) "largest error of a time [t_c]";
    because "the rate of m.n, as exact as the motion, over a second derivative of 0.19 or more";
}

fn signal_of_reference_motion() -> Result<Measured, String> {
    worst_of(reference_motions(), |scene| {
        let end = scene.states.last().map_or(0.0, |(t, _)| *t);
        let motion = scene.problem().taylor((0.0, end), 1e-14)?;
        let axes = [(0.5, 0.0), (1.3, 0.7), (2.8, -2.0)].into_iter();
        let pairs = axes.flat_map(|axis| [(0.8, 0.0), (1.5, 2.2), (2.9, -1.1)].map(|observer| (axis, observer)));
        worst_of(pairs, |&((chi, delta), (theta_o, phi_o))| {
            let (beam, observer) = (Beam::new(chi, delta, 0.6), Observer::at(theta_o, phi_o));
            worst_of(&scene.states, |(t, reference)| {
                let state = motion.state(*t)?;
                let theirs = beam.direction(reference).dot(&observer.direction);
                // At a pole the motion has no angles.
                let angles = state.angles().ok();
                let in_angles = angles.map(|q| axis_along_line_of_sight(&q, chi, delta, theta_o, phi_o));
                let ours = [beam.direction(&state).dot(&observer.direction)].into_iter().chain(in_angles);
                Ok(largest(ours.map(|ours| (ours - theirs).abs())))
            })
        })
    })
}

/// The largest error of a pulse, from the found and the expected one.
fn worst_pulse(error: fn(&Pulse, &Arrival, &ReferencePulse) -> f64) -> Result<Measured, String> {
    worst_of(["tp-1", "tp-2"], |name| {
        let expected = reference_pulses(name);
        let end = expected.last().map_or(f64::NAN, |pulse| pulse.end + 0.1);
        let signal = paper_signal(name, end)?;
        let (train, found) = (signal.train()?, signal.arrivals()?);
        let whole: Vec<_> = train.pulses.iter().filter(|pulse| pulse.is_whole()).collect();
        if whole.len() != expected.len() || found.len() != expected.len() || expected.len() < 150 {
            return Ok(Measured::new(f64::INFINITY, format!("{} pulses of {}", whole.len(), expected.len())));
        }
        worst_of(whole.iter().zip(&found).zip(&expected), |((pulse, arrival), expected)| {
            Ok(error(pulse, arrival, expected))
        })
    })
}
