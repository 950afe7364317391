//! Simulated measurements of random stars, for the coverage of error bars.

use crate::prelude::*;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use twofold::inference::{Datum, Fit, fit, nonlinearity};
use twofold::parameters::ThirdRate;
use twofold_scene::measurements::{beside, with_noise};

/// Kinds of simulated measurements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Campaign {
    /// Arrival times and widths of pulses: thirteen unknowns.
    Pulses,
    /// Both polarizations of the wave: ten unknowns.
    Strain,
    /// Arrival times and both polarizations: thirteen unknowns.
    Both,
}

/// One simulated measurement of a random star.
#[derive(Debug, Clone)]
pub struct Simulation {
    /// The truth.
    pub truth: Parameters<f64>,
    /// The unknowns of the fit.
    pub unknowns: Vec<Parameter>,
    /// Data with errors.
    pub data: Vec<Datum>,
    /// Start of the fit: the truth plus a draw of three times the standard deviations.
    pub start: Parameters<f64>,
    /// End of the span.
    pub end: f64,
    /// Number of scenes rejected before this one.
    pub refused: usize,
}

/// Fewest pulses of a simulated measurement.
const FEWEST: usize = 12;

/// Largest number of scenes drawn for one measurement.
const MOST_DRAWN: usize = 1000;

/// Largest [`nonlinearity`] of a measurement whose error bars are tested. Above it they need not hold.
pub(crate) const LINEAR: f64 = 0.1;

impl Simulation {
    /// Measurement `seed`. Scenes are drawn until one is determined by data without errors. The errors are drawn afterwards and
    /// decide nothing.
    ///
    /// # Errors
    /// If a motion cannot be computed, or none of a thousand scenes is accepted; one of eight or nine is.
    pub fn new(seed: u64) -> Result<Self, InferenceError> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let campaign = [Campaign::Pulses, Campaign::Strain, Campaign::Both][(seed % 3) as usize];
        for refused in 0..MOST_DRAWN {
            let truth = random_model(&mut random);
            let end = random.random_range(60.0..120.0);
            let sigma = 10.0_f64.powf(random.random_range(-5.5..-4.5));
            let Some((exact, fisher)) = determined(&truth, campaign, end, sigma)? else { continue };
            let data = with_noise(&exact, &mut random);
            let start = beside(&fisher, 3.0, &mut random)?;
            return Ok(Self { truth, unknowns: fisher.unknowns, data, start, end, refused });
        }
        Err(Error::not_found("draw of a scene that its data determine").into())
    }

    /// The fit.
    ///
    /// # Errors
    /// Those of [`fit`].
    pub fn fit(&self) -> Result<Fit, InferenceError> {
        fit(&self.start, &self.data, &self.unknowns, self.end)
    }
}

/// Exact data and their Fisher matrix, if the scene has enough pulses, none of them short, and the data determine it so
/// well that `chi^2` is parabolic over the error bars.
fn determined(
    truth: &Parameters<f64>,
    campaign: Campaign,
    end: f64,
    sigma: f64,
) -> Result<Option<(Vec<Datum>, Fisher)>, InferenceError> {
    let signal = Signal::new(truth, end)?;
    let turn = signal.turn();
    // Without the first turn, whose pulse may be cut for a start beside the truth. Short pulses may disappear.
    let events: Vec<_> = if campaign == Campaign::Strain {
        Vec::new()
    } else {
        // About a line of sight along L there are no turns.
        let Ok(found) = signal.events() else { return Ok(None) };
        if found.iter().any(|event| event.end - event.start < 0.1 * turn) {
            return Ok(None);
        }
        let found: Vec<_> = found.into_iter().filter(|event| event.start > turn).collect();
        if found.len() < FEWEST {
            return Ok(None);
        }
        found
    };
    // The strains of these stars are of the order of eps.
    let strain =
        [Observable::StrainPlus, Observable::StrainCross].map(|kind| (kind, sigma * truth.spheroid.oblateness()));
    let (unknowns, noise) = match campaign {
        Campaign::Pulses => {
            (Parameter::OF_PULSES.to_vec(), vec![(Observable::Arrivals, sigma), (Observable::Widths, sigma)])
        }
        Campaign::Strain => (Parameter::OF_STRAIN.to_vec(), strain.to_vec()),
        Campaign::Both => (Parameter::OF_PULSES.to_vec(), [&[(Observable::Arrivals, sigma)][..], &strain].concat()),
    };
    let samples: Vec<f64> = (0..40).map(|k| end * (f64::from(k) / 39.0)).collect();
    let data = data_of(&signal, &events, &samples, &noise)?;
    if data.len() < 2 * unknowns.len() {
        return Ok(None);
    }
    let Ok(fisher) = Fisher::of(truth, &events, &data, &unknowns)?.determined() else { return Ok(None) };
    // If a model beside the truth lacks pulses of the data, it is far from linear, too.
    let linear = nonlinearity(&fisher, &data, end).is_ok_and(|found| found < LINEAR);
    Ok(linear.then_some((data, fisher)))
}

/// A star in any motion between both kinds of precession, seen from any direction off the poles.
fn random_model(random: &mut ChaCha8Rng) -> Parameters<f64> {
    let mut within = |low: f64, high: f64| random.random_range(low..high);
    let mut sign = |size: f64| size * if within(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 };
    let (axial, asymmetry) = (sign(0.1), sign(0.04));
    let (axial, asymmetry) = (axial * within(0.3, 1.0), asymmetry * within(0.3, 1.0));
    let zz = axial / 3.0;
    let spheroid = RigidSpheroid::in_units_of_tc(1.0 + within(0.05, 0.3));
    let s = Matrix3::from_diagonal(&[(asymmetry - zz) / 2.0, (-asymmetry - zz) / 2.0, zz].into());
    let angles = EulerAngles { alpha: within(-3.0, 3.0), beta: within(0.4, 1.3), gamma: within(-3.0, 3.0) };
    let rates = EulerRates { alpha: within(0.0, 1.6), beta: within(-0.3, 0.3), gamma: 0.0 };
    Parameters {
        third_rate: ThirdRate::Spin(within(0.7, 1.3)),
        chi: within(0.3, 1.2),
        rho: within(0.4, 0.9),
        theta_o: within(0.4, 2.7),
        phi_o: within(-3.0, 3.0),
        delta: within(-3.0, 3.0),
        ..Parameters::new(spheroid, s, angles, rates)
    }
}
