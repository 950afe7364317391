//! The paper's pulsar and wave signals of tp-I and tp-II as line lists, computed once for all checks and golden tables.

use std::sync::OnceLock;

use crate::prelude::*;
use twofold::observables::fundamental_frequencies::FundamentalFrequencies;
use twofold::observables::gravitational_wave::{Polarizations, wave_of_state};
use twofold::observables::spectrum::FrequencyBasis;

/// Angles of the paper's figures: observer, magnetic axis, half opening of the beam (rad).
const THETA_O: f64 = 0.8;
const CHI: f64 = 0.5;
const RHO: f64 = 0.6;

/// Span over which rates are averaged [t_c].
pub(super) const AVERAGING: f64 = 2400.0;

/// Span and number of samples of the signals. Of m.n of tp-II, four slow turns are nearly one modulation: its
/// lines come in pairs 0.0024 apart, which takes longer to resolve.
const SIGNAL: (f64, usize) = (6000.0, 16_384);
const PAIRED_SIGNAL: (f64, usize) = (16_000.0, 40_960);

/// A twofold example with its signals.
pub(crate) struct Example {
    /// Name in the paper.
    pub name: &'static str,
    /// Fundamental frequencies.
    pub frequencies: FundamentalFrequencies,
    /// Their combinations.
    pub basis: FrequencyBasis,
    /// Lines of `m.n` above 1e-4, of `h_+` and `h_x` above 1e-6 (`r = 1`).
    pub pulsar: LineList,
    /// `h_+`.
    pub plus: LineList,
    /// `h_x`.
    pub cross: LineList,
    /// The motion over [`SIGNAL`].
    pub(super) motion: TaylorMotion<f64>,
}

crate::reference::named!(Example);

impl Example {
    /// `h_+` and `h_x`.
    pub fn waves(&self) -> [(&'static str, &LineList); 2] {
        [("h_+", &self.plus), ("h_x", &self.cross)]
    }

    /// All three signals.
    pub fn signals(&self) -> [(&'static str, &LineList); 3] {
        [("m.n", &self.pulsar), ("h_+", &self.plus), ("h_x", &self.cross)]
    }
}

/// tp-I and tp-II.
pub(crate) fn examples() -> Result<&'static [Example; 2], String> {
    static EXAMPLES: OnceLock<Result<[Example; 2], String>> = OnceLock::new();
    let examples = EXAMPLES.get_or_init(|| {
        let example = |name, scene, signal| example(name, scene, signal).map_err(|e| format!("{name}: {e}"));
        Ok([example("tp-I", "tp-1", SIGNAL)?, example("tp-II", "tp-2", PAIRED_SIGNAL)?])
    });
    examples.as_ref().map_err(Clone::clone)
}

fn example(name: &'static str, scene: &str, (span, count): (f64, usize)) -> Result<Example, Error> {
    let frequencies = fundamental_frequencies(&motion_of(scene, AVERAGING)?)?;
    let motion = motion_of(scene, SIGNAL.0)?;
    let wave = |part: fn(Polarizations<f64>) -> f64| {
        let series = Series::of_motion(&motion, SIGNAL.1, |state| part(wave_of(&motion, state)))?;
        spectral_lines(&series, 1e-6, 200)
    };
    let (beam, observer) = (beam(), line_of_sight());
    let long = motion_of(scene, span)?;
    let pulsar = Series::of_motion(&long, count, |state| beam.direction(state).dot(&observer))?;
    Ok(Example {
        name,
        frequencies,
        basis: frequencies.basis()?,
        pulsar: spectral_lines(&pulsar, 1e-4, 200)?,
        plus: wave(|h| h.plus)?,
        cross: wave(|h| h.cross)?,
        motion,
    })
}

/// A reference motion over a span.
pub(super) fn motion_of(name: &str, span: f64) -> Result<TaylorMotion<f64>, Error> {
    reference_motion(name).problem().taylor((0.0, span), 1e-13)
}

pub(super) fn beam() -> Beam<f64> {
    Beam::new(CHI, 0.0, RHO)
}

pub(super) fn line_of_sight() -> Vector3<f64> {
    Observer::at(THETA_O, 0.0).direction
}

/// The wave of a state of a motion for the paper's observer.
pub(super) fn wave_of(motion: &TaylorMotion<f64>, state: &BodyState<f64>) -> Polarizations<f64> {
    let observer = Observer::at(THETA_O, 0.0);
    wave_of_state(motion.spheroid(), motion.coefficients(), &state.axis_state(), &observer)
}

/// The strongest line with a frequency in a range.
pub(crate) fn strongest(list: &LineList, range: std::ops::Range<f64>) -> Result<&SpectralLine, String> {
    list.lines
        .iter()
        .find(|line| range.contains(&line.frequency))
        .ok_or_else(|| format!("no line between {} and {}", range.start, range.end))
}
