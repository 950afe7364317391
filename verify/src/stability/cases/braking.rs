//! The harmonics of the torque on a wobbling star, and a wobble that friction damps.

use twofold::spin_down::{Precession as FreePrecession, TorqueHarmonics};

use super::parts::*;

/// Wobble, angle of the magnetic axis, damping. The rate is one.
fn precession<S: Real>(x: &[S]) -> FreePrecession<S> {
    FreePrecession::new([x[0], x[1], S::one()], S::one(), x[2])
}

functions! {
    Harmonics: "TorqueHarmonics::new", (x) {
        let TorqueHarmonics { constant, once, twice } = TorqueHarmonics::new(x[0], x[1]);
        vec![constant, once, twice]
    }
    Wobble: "Precession: wobble_at".composite(), (x) { vec![precession(x).wobble_at(S::one())] }
    Ahead: "Precession: ahead".composite(), (x) { vec![precession(x).ahead(S::one())] }
}

pub(super) fn cases() -> Vec<Case> {
    let (small, angle) = (Log(-300.0, -1.0), In(0.2, 1.3));
    vec![
        Harmonics::case("n -> L", &[small, angle]),
        Harmonics::case("magnetic axis -> n", &[angle, small]),
        Harmonics::case("both, the magnetic axis -> L", &[Log(-150.0, -1.0), Log(-150.0, -1.0)]),
        Harmonics::case("right angles", &[Near(FRAC_PI_2, -15.0, -1.0), Near(FRAC_PI_2, -15.0, -1.0)]),
        Wobble::case("damping -> 0", &[angle, angle, Signed(-300.0, -1.0)]),
        Wobble::case("damping to 2", &[angle, angle, Signed(-1.0, 0.3)]),
        Wobble::case("wobble -> 0", &[small, angle, Signed(-1.0, 0.3)]),
        Ahead::case("damping -> 0", &[angle, angle, Signed(-300.0, -1.0)]),
        Ahead::case("damping to 2", &[angle, angle, Signed(-1.0, 0.3)]),
        Ahead::case("wobble -> 0", &[Log(-100.0, -1.0), angle, Signed(-1.0, 0.3)]),
    ]
}
