//! Random pulsars for the checks of the pulse train, and those of the paper.

use std::f64::consts::PI;

use nalgebra::Vector3;
use twofold::Error;
use twofold::dynamics::BodyState;
use twofold::observables::pulsar::{Beam, PulseTrain, pulse_train};
use twofold::propagation::{Motion, TaylorMotion, propagate};

use crate::physical_domain::scenes;
use crate::random::Random;
use crate::reference::{ReferenceMotion, reference_motion};

/// A random motion with a beam and an observer.
pub(super) struct Case {
    pub(super) name: String,
    pub(super) motion: TaylorMotion<f64>,
    pub(super) beam: Beam<f64>,
    pub(super) observer: Vector3<f64>,
}

impl Case {
    pub(super) fn margin(&self, t: f64) -> [f64; 4] {
        let motion = &self.motion;
        let state = motion.state(t).expect("a time of the span");
        self.beam.margin_rates(motion.spheroid(), motion.coefficients(), &state, &self.observer)
    }

    pub(super) fn train(&self) -> Result<PulseTrain, String> {
        pulse_train(&self.motion, &self.beam, &self.observer, self.motion.span())
            .map_err(|e| format!("{}: {e}", self.name))
    }
}

/// Sees `count` random scenes, propagated to the time `end` with the given accuracy, each with a random beam and its opposite.
pub(super) fn for_random_cases(
    seed: u8,
    count: usize,
    (end, accuracy): (f64, f64),
    mut see: impl FnMut(&Case) -> Result<(), String>,
) -> Result<(), String> {
    let mut random = Random::with_seed(u64::from(seed));
    let mut index = 0;
    let cell = std::cell::RefCell::new((&mut random, &mut index, &mut see));
    crate::physical_domain::worst_over(seed, count, &scenes(), |scene| {
        let (random, index, see) = &mut *cell.borrow_mut();
        let motion =
            propagate(&scene.spheroid(), &scene.coefficients().tensor(), &scene.state(), (0.0, end), accuracy)?;
        let (chi, delta) = (random.within(0.0, PI), random.within(-PI, PI));
        let (theta, phi) = (random.within(0.0, PI), random.within(-PI, PI));
        let observer = Vector3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        let beam = Beam::new(chi, delta, random.within(0.05, 2.0));
        let name = format!("scene {index} of seed {seed}, beam {beam:?}, observer {observer:?}");
        let mut case = Case { name, motion, beam, observer };
        see(&case)?;
        case.beam = beam.opposite();
        see(&case)?;
        **index += 1;
        Ok(0.0)
    })
    .map(|_| ())
}

pub(super) fn edges(train: &PulseTrain) -> Vec<f64> {
    let pulses = train.pulses.iter();
    pulses.flat_map(|p| [(!p.cut_at_start).then_some(p.start), (!p.cut_at_end).then_some(p.end)]).flatten().collect()
}

/// The motion, beam and observer of the paper's pulsar signals.
pub(super) struct Signal {
    pub(super) motion: TaylorMotion<f64>,
    pub(super) beam: Beam<f64>,
    pub(super) observer: Vector3<f64>,
}

/// The signal of an example, over 400 t_c.
pub(super) fn paper_signal(name: &str) -> Result<Signal, Error> {
    paper_signal_until(name, 400.0)
}

/// The signal of an example up to the time `end`.
pub(super) fn paper_signal_until(name: &str, end: f64) -> Result<Signal, Error> {
    let reference = reference_motion(name);
    signal_from(&reference, &reference.initial(), end)
}

/// The signal of an example from another start.
pub(super) fn signal_from(reference: &ReferenceMotion, start: &BodyState<f64>, end: f64) -> Result<Signal, Error> {
    let motion = propagate(&reference.spheroid, &reference.violation(), start, (0.0, end), 1e-14)?;
    let theta_o: f64 = 0.8;
    let observer = Vector3::new(theta_o.sin(), 0.0, theta_o.cos());
    Ok(Signal { motion, beam: Beam::new(0.5, 0.0, 0.6), observer })
}
