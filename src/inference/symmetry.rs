//! Changes of a scene that no observer can see, or that two unknowns share: names for degenerate directions.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;
use twofold::Real;
use twofold::euler_angles::EulerAngles;

use super::{Model, Unknown};

/// A change of the unknowns, the same for all data of some kind, in words.
pub(super) struct Symmetry {
    /// What cannot be told.
    pub(super) words: &'static str,
    /// The change of each unknown, in its unit; those that are not named do not change.
    pub(super) change: Vec<(Unknown, f64)>,
}

/// The symmetries of a model, the simplest first.
pub(super) fn symmetries(model: &Model<f64>) -> Vec<Symmetry> {
    let s = |unknown: Unknown| unknown.value(model);
    let components = [Unknown::SAxial, Unknown::SAsymmetry, Unknown::SXy, Unknown::SXz, Unknown::SYz];
    let along_s = |with: (Unknown, f64)| {
        let parts = components.iter().map(|unknown| (*unknown, s(*unknown)));
        parts.chain([with]).collect::<Vec<_>>()
    };
    let mut all = vec![
        Symmetry {
            words: "the trace of s^IJ: a multiple of the unit tensor turns nothing",
            change: vec![(Unknown::STrace, 1.0)],
        },
        Symmetry {
            words: "C against the size of s^IJ: only C s^IJ / I^xx moves the star",
            change: vec![(Unknown::ConstantC, model.constant_c), (Unknown::SScale, -model.s_scale)],
        },
        Symmetry {
            words: "C against s^IJ: only C s^IJ / I^xx moves the star",
            change: along_s((Unknown::ConstantC, -model.constant_c)),
        },
        Symmetry {
            words: "the size of s^IJ against its components, which say the same",
            change: along_s((Unknown::SScale, -model.s_scale)),
        },
        Symmetry {
            words: "gamma against delta: only gamma + delta, the place of the beam, is seen",
            change: vec![(Unknown::Gamma, 1.0), (Unknown::Delta, -1.0)],
        },
        Symmetry {
            words: "gamma: a spheroid looks alike from all sides, and no beam is seen",
            change: vec![(Unknown::Gamma, 1.0)],
        },
        Symmetry { words: "chi: no pulses are among the data", change: vec![(Unknown::Chi, 1.0)] },
        Symmetry { words: "delta: no pulses are among the data", change: vec![(Unknown::Delta, 1.0)] },
        Symmetry { words: "rho: no pulses are among the data", change: vec![(Unknown::Rho, 1.0)] },
        Symmetry {
            words: "eps against Omega^z and the strain scale: the axis moves by I^zz Omega^z, and h is in proportion to eps I^xx / r",
            change: vec![
                (Unknown::Oblateness, -model.oblateness),
                (Unknown::Spin, model.spin * model.oblateness / (1.0 + model.oblateness)),
                (Unknown::StrainScale, model.strain_scale),
            ],
        },
        Symmetry {
            words: "the strain scale: there is no strain among the data",
            change: vec![(Unknown::StrainScale, 1.0)],
        },
    ];
    let turns = [
        (Vector3::z(), "a rotation of all (star, s^IJ and observer) about Z: no direction in space is marked"),
        (Vector3::y(), "a rotation of all (star, s^IJ and observer) about Y: no direction in space is marked"),
        (Vector3::x(), "a rotation of all (star, s^IJ and observer) about X: no direction in space is marked"),
    ];
    all.extend(turns.into_iter().filter_map(|(axis, words)| Some(Symmetry { words, change: rotation(model, axis)? })));
    all
}

/// The change of all unknowns with a rotation of the inertial frame, where no pole is met.
fn rotation(model: &Model<f64>, axis: Vector3<f64>) -> Option<Vec<(Unknown, f64)>> {
    let small = Dual64::new(0.0, 1.0);
    let cross: Matrix3<Dual64> = axis.cross_matrix().map(|value| small * value);
    let turn = Matrix3::identity() + cross;
    let lifted = model.lifted::<Dual64>();
    let start = lifted.start();
    let state = start.state().rotated(&turn);
    let angles: EulerAngles<Dual64> = state.angles().ok()?;
    let rates = state.rates(&start.spheroid).ok()?;
    let s = turn * start.violation * turn.transpose();
    let n = turn * lifted.observer().direction;
    let across = (n.x * n.x + n.y * n.y).sqrt();
    if across.re < 1e-6 {
        return None;
    }
    Some(vec![
        (Unknown::SAxial, (s[(2, 2)] * 2.0 - s[(0, 0)] - s[(1, 1)]).eps),
        (Unknown::SAsymmetry, (s[(0, 0)] - s[(1, 1)]).eps),
        (Unknown::SXy, s[(0, 1)].eps),
        (Unknown::SXz, s[(0, 2)].eps),
        (Unknown::SYz, s[(1, 2)].eps),
        (Unknown::Alpha, angles.alpha.eps),
        (Unknown::Beta, angles.beta.eps),
        (Unknown::Gamma, angles.gamma.eps),
        (Unknown::AlphaRate, rates.alpha.eps),
        (Unknown::BetaRate, rates.beta.eps),
        (Unknown::ThetaO, Real::atan2(across, n.z).eps),
        (Unknown::PhiO, Real::atan2(n.y, n.x).eps),
    ])
}
