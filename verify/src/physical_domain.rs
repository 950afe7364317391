//! Random physical scenes: proptest strategies over the domain of the equations, run with a fixed seed by the checks.

use crate::prelude::*;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// A random scene.
#[derive(Debug, Clone, Copy)]
pub struct RandomScene {
    /// The body.
    pub spheroid: RigidSpheroid<f64>,
    /// Eigenvalues of `s^IJ`.
    pub s: PrincipalCoefficients<f64>,
    /// Euler angles at the start.
    pub angles: EulerAngles<f64>,
    /// Euler rates at the start.
    pub rates: EulerRates<f64>,
}

impl RandomScene {
    /// The problem with this start.
    ///
    /// # Panics
    /// None: the scenes are physical.
    pub fn problem(&self) -> Problem<f64> {
        Problem::new(self.spheroid, self.s.tensor(), self.state()).expect("the scenes are physical")
    }

    /// State at the start.
    pub fn state(&self) -> BodyState<f64> {
        BodyState::from_angles(&self.spheroid, &self.angles, &self.rates)
    }
}

/// Scenes over the whole physical domain: `I^zz / I^xx` from 0.2 to 2 (the triangle inequality), `I^xx` from 0.7 to 1.4, `C` of either sign with
/// sizes from 0.5 to 1.5, any orientation at least 0.05 rad from the poles, rates up to 2, coefficients of either sign with sizes from 1e-8 to
/// 0.3.
pub fn scenes() -> impl Strategy<Value = RandomScene> {
    let coefficient = (-8.0..-0.523f64, any::<bool>()).prop_map(|(log, negative)| {
        let size = 10f64.powf(log);
        if negative { -size } else { size }
    });
    (
        0.2..2.0f64,
        prop::array::uniform3(coefficient),
        (-PI..PI, 0.05..PI - 0.05, -PI..PI),
        prop::array::uniform3(-2.0..2.0f64),
        (0.7..1.4f64, 0.5..1.5f64, any::<bool>()),
    )
        .prop_map(|(inertia_ratio, s, (alpha, beta, gamma), rates, (inertia_xx, size, negative))| RandomScene {
            spheroid: RigidSpheroid {
                inertia_xx,
                inertia_zz: inertia_xx * inertia_ratio,
                constant_c: if negative { -size } else { size },
            },
            s: PrincipalCoefficients::new(s),
            angles: EulerAngles { alpha, beta, gamma },
            rates: EulerRates { alpha: rates[0], beta: rates[1], gamma: rates[2] },
        })
}

/// Some values of `strategy`, drawn with the given seed.
///
/// # Errors
/// If the strategy rejects too many values.
pub fn drawn<T: Strategy>(seed: u8, cases: usize, strategy: &T) -> Result<Vec<T::Value>, String> {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    (0..cases).map(|_| Ok(strategy.new_tree(&mut runner).map_err(|reason| reason.to_string())?.current())).collect()
}

/// The largest figure of `measure` over `cases` values of `strategy`, drawn with the given seed.
pub fn worst_over<T: Strategy, F: Figure>(
    seed: u8,
    cases: usize,
    strategy: &T,
    mut measure: impl FnMut(&T::Value) -> Result<F, String>,
) -> Result<Measured, String> {
    worst_of(drawn(seed, cases, strategy)?.iter().enumerate(), |(case, value)| {
        let found = measure(value).map_err(|error| format!("case {case} of seed {seed}, {value:?}: {error}"))?;
        let of_seed = |Measured { figure, detail }| Measured::new(figure, format!("of seed {seed} {detail}"));
        Ok(found.measured().map(of_seed))
    })
}
