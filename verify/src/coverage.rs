//! Coverage of the error bars: fits of many simulated measurements compared with the true parameters.

use rayon::prelude::*;

use crate::prelude::*;
use crate::simulation::Simulation;
use crate::timing_simulation::{TimingSimulation, UNKNOWNS};
use twofold::inference::{Fit, Model, fit_timing};

/// One fit compared with the truth.
#[derive(Debug, Clone)]
pub struct Case {
    /// Number of the simulation.
    pub seed: u64,
    /// Number of scenes rejected before this one.
    pub refused: usize,
    /// Fitted minus true value, in standard deviations, for each unknown.
    pub pulls: Vec<f64>,
    /// `d^T C^-1 d` for the differences `d` and the covariance `C`: a chi^2 with as many degrees of freedom as unknowns.
    pub distance: f64,
    /// `chi^2` of the residuals.
    pub chi_squared: f64,
    /// Its degrees of freedom.
    pub degrees: usize,
    /// Steps of the fit.
    pub iterations: usize,
}

/// The fits of simulations.
#[derive(Debug, Clone, Default)]
pub struct Coverage {
    /// The fits that ended at a minimum.
    pub cases: Vec<Case>,
    /// The fits that did not.
    pub failed: Vec<(u64, InferenceError)>,
}

impl Case {
    fn new<M: Model>(seed: u64, refused: usize, found: &Fit<M>, truth: &M) -> Self {
        let Fisher { parameters, unknowns, .. } = &found.fisher;
        let differences = unknowns.iter().map(|unknown| parameters.difference(truth, *unknown));
        let pulls: Vec<f64> = differences.zip(found.fisher.sigmas()).map(|(change, sigma)| change / sigma).collect();
        // In units of the standard deviations, where the matrix is best conditioned.
        let vector = DVector::from_column_slice(&pulls);
        let solved = found.fisher.correlations().cholesky().map(|factors| factors.solve(&vector));
        Self {
            seed,
            refused,
            distance: solved.map_or(f64::NAN, |solved| solved.dot(&vector)),
            pulls,
            chi_squared: found.chi_squared,
            degrees: found.degrees,
            iterations: found.iterations,
        }
    }

    /// The fit of a motion over 60 to 120 t_c.
    pub fn of_motion(seed: u64) -> Result<Self, InferenceError> {
        let simulation = Simulation::new(seed)?;
        Ok(Self::new(seed, simulation.refused, &simulation.fit()?, &simulation.truth))
    }

    /// The fit of a pulsar over 10 to 20 years.
    pub fn of_pulsar(seed: u64) -> Result<Self, InferenceError> {
        let TimingSimulation { truth, start, data, refused } = TimingSimulation::new(seed)?;
        Ok(Self::new(seed, refused, &fit_timing(&start, &data, &UNKNOWNS)?, &truth))
    }
}

/// A number that should be standard normal.
#[derive(Debug, Clone)]
pub struct Score {
    /// The quantity that was counted or summed.
    pub what: &'static str,
    /// Value found.
    pub found: f64,
    /// Value expected.
    pub expected: f64,
    /// The difference in standard deviations.
    pub score: f64,
}

impl Coverage {
    /// The simulations with the given numbers, on all threads: [`Case::of_motion`] or [`Case::of_pulsar`].
    pub fn of(seeds: std::ops::Range<u64>, case: fn(u64) -> Result<Case, InferenceError>) -> Self {
        let mut coverage = Self::default();
        let cases: Vec<_> = seeds.into_par_iter().map(|seed| (seed, case(seed))).collect();
        for (seed, case) in cases {
            match case {
                Ok(case) => coverage.cases.push(case),
                Err(error) => coverage.failed.push((seed, error)),
            }
        }
        coverage
    }

    /// Scores that are standard normal if every error bar holds: sums over independent cases. The pulls of one case are dependent,
    /// so that counts take one unknown of each case, a different one from case to case.
    pub fn scores(&self) -> Vec<Score> {
        let count = self.cases.len() as f64;
        let one_each = || self.cases.iter().map(|case| case.pulls[(case.seed as usize / 3) % case.pulls.len()]);
        let within = |what, limit: f64, part: f64| {
            let found = one_each().filter(|pull| pull.abs() <= limit).count() as f64;
            let deviation = (count * part * (1.0 - part)).sqrt();
            Score { what, found: found / count, expected: part, score: (found - count * part) / deviation }
        };
        let sum = |what, value: fn(&Case) -> f64, degrees: fn(&Case) -> usize| {
            let found: f64 = self.cases.iter().map(value).sum();
            let expected = self.cases.iter().map(degrees).sum::<usize>() as f64;
            Score { what, found: found / expected, expected: 1.0, score: (found - expected) / (2.0 * expected).sqrt() }
        };
        let mean = one_each().sum::<f64>() / count;
        vec![
            within("within one standard deviation", 1.0, 0.682_689_492),
            within("within two", 2.0, 0.954_499_736),
            within("within three", 3.0, 0.997_300_204),
            Score { what: "mean pull", found: mean, expected: 0.0, score: mean * count.sqrt() },
            sum("chi^2 of the unknowns / degrees", |case| case.distance, |case| case.pulls.len()),
            sum("chi^2 of the residuals / degrees", |case| case.chi_squared, |case| case.degrees),
        ]
    }

    /// The largest score, if every fit ended at a minimum. The count within three standard deviations is left out: it is not normal for so few cases.
    pub(crate) fn worst_score(&self) -> Result<Measured, String> {
        if let Some((seed, error)) = self.failed.first() {
            return Err(format!("seed {seed}: {error}"));
        }
        let scores: Vec<_> = self.scores().into_iter().filter(|score| score.what != "within three").collect();
        let listed: Vec<_> =
            scores.iter().map(|score| format!("{} {:.3} for {:.3}", score.what, score.found, score.expected)).collect();
        Ok(Measured::new(largest(scores.iter().map(|score| score.score.abs())), listed.join(", ")))
    }
}
