//! Pulsars for the checks of the pulse train: random ones, those of the paper, and some that spin about Z.

use crate::prelude::*;
use twofold::observables::pulsar::PulseTrain;
use twofold::solutions::perturbation::ShiftedRates;

/// A motion with a beam and an observer.
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
        self.beam.margin_rates(motion.spheroid(), motion.coefficients(), 0.0, &state, &self.observer)
    }

    pub(super) fn train(&self) -> Result<PulseTrain, String> {
        Ok(pulse_train(&self.motion, &self.beam, &self.observer, self.motion.span())?)
    }

    pub(super) fn arrivals(&self) -> Result<Vec<Arrival>, String> {
        Ok(arrivals(&self.motion, &self.beam, &self.observer, &self.train()?)?)
    }

    /// Largest difference between two lists of edges, in units of `m.n`; infinite if their lengths differ.
    pub(super) fn difference_of_edges(&self, first: &[f64], second: &[f64]) -> f64 {
        if first.len() != second.len() {
            return f64::INFINITY;
        }
        // Two lists without edges agree.
        if first.is_empty() {
            return 0.0;
        }
        largest(first.iter().zip(second).map(|(a, b)| (a - b).abs() * self.margin(*a)[1].abs().min(1.0)))
    }

    /// A bound on the angular velocity of the body.
    pub(super) fn turning(&self, state: &BodyState<f64>) -> f64 {
        state.momentum.norm() / self.motion.spheroid().inertia_zz.min(self.motion.spheroid().inertia_xx)
    }
}

/// The largest figure of random scenes, propagated to the time `end` with the given tolerance, each with a random beam and its opposite.
pub(super) fn worst_over_random_cases<F: Figure>(
    seed: u8,
    count: usize,
    (end, tolerance): (f64, f64),
    mut figure: impl FnMut(&Case) -> Result<F, String>,
) -> Result<Measured, String> {
    let mut random = Random::with_seed(u64::from(seed));
    worst_over(seed, count, &scenes(), |scene| {
        let motion = scene.problem().taylor((0.0, end), tolerance)?;
        let (chi, delta) = (random.within(0.0, PI), random.within(-PI, PI));
        let (theta, phi) = (random.within(0.0, PI), random.within(-PI, PI));
        let observer = Observer::at(theta, phi).direction;
        let beam = Beam::new(chi, delta, random.within(0.05, 2.0));
        let mut case = Case { name: format!("{beam:?}, observer {observer:?}"), motion, beam, observer };
        let first = figure(&case)?.measured();
        case.beam = beam.opposite();
        let second = figure(&case)?.measured();
        let worse = |a: Measured, b: Measured| if b.figure > a.figure || b.figure.is_nan() { b } else { a };
        let worst = [first, second].into_iter().flatten().reduce(worse);
        Ok(worst.map(|Measured { figure, detail }| Measured::new(figure, format!("{} {detail}", case.name))))
    })
}

/// The edges of the pulses, without those at which the train is cut.
pub(super) fn edges(train: &PulseTrain) -> Vec<f64> {
    let pulses = train.pulses.iter();
    pulses.flat_map(|p| [(!p.cut_at_start).then_some(p.start), (!p.cut_at_end).then_some(p.end)]).flatten().collect()
}

/// The paper's pulsar signal of an example up to the time `end`.
pub(super) fn paper_signal(name: &str, end: f64) -> Result<Case, String> {
    signal_of(name, &reference_motion(name).problem(), end)
}

/// The signal of another motion for the beam and the observer of the paper.
pub(super) fn signal_of(name: &str, problem: &Problem<f64>, end: f64) -> Result<Case, String> {
    let motion = problem.taylor((0.0, end), 1e-14)?;
    let observer = Observer::at(0.8, 0.0).direction;
    Ok(Case { name: name.to_owned(), motion, beam: Beam::new(0.5, 0.0, 0.6), observer })
}

/// Mean rates of `alpha` and `gamma` over the span of a motion, which begins at the time zero.
pub(super) fn mean_rates(motion: &TaylorMotion<f64>) -> Result<ShiftedRates<f64>, twofold::Error> {
    let (_, end) = motion.span();
    let start = motion.state(0.0)?.angles()?;
    let last = ContinuousAngles::new(motion, 0.0, &start)?.at(end)?;
    Ok(ShiftedRates { alpha: (last.alpha - start.alpha) / end, gamma: (last.gamma - start.gamma) / end })
}

/// A star that spins about Z, which is its axis.
pub(super) fn upright_star(inertia_ratio: f64, spin: f64) -> Result<Problem<f64>, String> {
    let angles = EulerAngles { alpha: 0.0, beta: 0.0, gamma: 0.0 };
    let rates = EulerRates { alpha: 0.0, beta: 0.0, gamma: spin };
    Ok(Problem::from_angles(RigidSpheroid::in_units_of_tc(inertia_ratio), Matrix3::zeros(), &angles, &rates)?)
}
