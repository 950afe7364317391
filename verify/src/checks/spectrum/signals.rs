//! The paper's pulsar and wave signals of tp-I and tp-II as line lists, computed once for all checks and golden tables.

use std::sync::OnceLock;

use crate::prelude::*;
use twofold::observables::gravitational_wave::{Polarizations, wave_of_state};

/// Angles of the paper's figures: observer, magnetic axis, half opening of the beam (rad).
const THETA_O: f64 = 0.8;
const CHI: f64 = 0.5;
const RHO: f64 = 0.6;

/// Smallest amplitude of a line, relative to the strongest one.
pub(super) const LEAST: f64 = 1e-12;

/// A twofold example with its signals.
pub(crate) struct Example {
    /// Name in the paper.
    pub name: &'static str,
    /// Name of the reference motion.
    pub(super) scene: &'static str,
    /// The motion as a function of its angles.
    pub exact: QuasiPeriodicMotion,
    /// Lines of `m.n`, `h_+` and `h_x` (`r = 1`).
    pub pulsar: LineList,
    /// `h_+`.
    pub plus: LineList,
    /// `h_x`.
    pub cross: LineList,
}

crate::reference::named!(Example);

impl Example {
    pub fn waves(&self) -> [(&'static str, &LineList); 2] {
        [("h_+", &self.plus), ("h_x", &self.cross)]
    }

    /// All three signals.
    pub fn signals(&self) -> [(&'static str, &LineList); 3] {
        [("m.n", &self.pulsar), ("h_+", &self.plus), ("h_x", &self.cross)]
    }

    /// A fundamental frequency.
    pub(super) fn rate(&self, symbol: &str) -> Result<f64, String> {
        rate(&self.exact, symbol)
    }
}

/// A fundamental frequency of a motion.
pub(super) fn rate(motion: &QuasiPeriodicMotion, symbol: &str) -> Result<f64, String> {
    motion.frequencies().rate(symbol).ok_or_else(|| format!("the motion has no {symbol}"))
}

/// tp-I and tp-II.
pub(crate) fn examples() -> Result<&'static [Example; 2], String> {
    static EXAMPLES: OnceLock<Result<[Example; 2], String>> = OnceLock::new();
    let examples = EXAMPLES.get_or_init(|| {
        let example = |name, scene| example(name, scene).map_err(|e| format!("{name}: {e}"));
        Ok([example("tp-I", "tp-1")?, example("tp-II", "tp-2")?])
    });
    examples.as_ref().map_err(Clone::clone)
}

/// The three signals of a state: `m.n`, `h_+` and `h_x`.
pub(super) fn signals_of(problem: &Problem<f64>, state: &BodyState<f64>) -> [f64; 3] {
    let wave = wave_of(problem, state);
    [beam().direction(state).dot(&line_of_sight()), wave.plus, wave.cross]
}

/// The lines of the three signals of a motion.
pub(super) fn lines_of_signals(problem: &Problem<f64>, exact: &QuasiPeriodicMotion) -> Result<[LineList; 3], Error> {
    let lines = |signal: usize| exact.lines(LEAST, |state| Ok::<_, Error>([signals_of(problem, state)[signal], 1.0]));
    Ok([lines(0)?, lines(1)?, lines(2)?])
}

fn example(name: &'static str, scene: &'static str) -> Result<Example, Error> {
    let problem = reference_motion(scene).problem();
    let exact = QuasiPeriodicMotion::new(&problem)?;
    let [pulsar, plus, cross] = lines_of_signals(&problem, &exact)?;
    Ok(Example { name, scene, exact, pulsar, plus, cross })
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

fn wave_of(problem: &Problem<f64>, state: &BodyState<f64>) -> Polarizations<f64> {
    let observer = Observer::at(THETA_O, 0.0);
    wave_of_state(problem.spheroid(), problem.coefficients(), &state.axis_state(), &observer)
}

/// The strongest line with a frequency in a range.
pub(crate) fn strongest(list: &LineList, range: std::ops::Range<f64>) -> Result<&SpectralLine, String> {
    list.lines
        .iter()
        .find(|line| range.contains(&line.frequency))
        .ok_or_else(|| format!("no line between {} and {}", range.start, range.end))
}
