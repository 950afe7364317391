//! The section `[spin_down]`.

use twofold::epoch::DAY;
use twofold::spin_down::Braking;

use super::Units;
use super::document::Section;
use super::fault::Fault;

/// The spin-down of a star, in terms of the derivatives of its frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpinDown {
    /// `F1` at the epoch (Hz/s).
    pub f1: f64,
    /// The braking index, or the `F2` (Hz/s^2) from which it follows.
    pub index: IndexOrSecond,
    /// Fraction of the torque that depends on the magnetic axis.
    pub torque_share: f64,
    /// Time (s) in which friction reduces the tangent of the wobble by a factor e.
    pub damping_time: Option<f64>,
}

/// The braking index `n = F0 F2 / F1^2`, or `F2`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum IndexOrSecond {
    /// The braking index.
    Index(f64),
    /// `F2` (Hz/s^2).
    Second(f64),
}

impl SpinDown {
    /// The braking law of a star with the frequency `F0` (Hz).
    ///
    /// # Errors
    /// A sentence for an `F2` for which the braking index is above 30 in size.
    pub fn braking(&self, frequency: f64) -> Result<Braking, String> {
        let index = match self.index {
            IndexOrSecond::Index(index) => index,
            IndexOrSecond::Second(second) => frequency * second / (self.f1 * self.f1),
        };
        if let (IndexOrSecond::Second(second), false) = (self.index, (-30.0..=30.0).contains(&index)) {
            return Err(format!(
                "`spin_down.f2` = {second:e}: the braking index F0 F2 / F1^2 is then {index:.4e}, and must be from -30 to 30. An F2 of timing noise is not \
                 a braking law; leave it out"
            ));
        }
        Ok(Braking { rate: -self.f1 / frequency, index, torque_share: self.torque_share })
    }
}

/// Named torques, with the fraction that depends on the magnetic axis.
const TORQUES: [(&str, f64); 3] = [("constant", 0.0), ("plasma", 0.5), ("vacuum", 1.0)];

pub(super) fn read(section: &Section<'_>, units: &Units) -> Result<SpinDown, Fault> {
    if !units.are_physical() {
        return Err(section.fault("[spin_down] is only for a physical star (`star.mass`); leave it out"));
    }
    section.only("f1 f2 index torque damping_time")?;
    section.not_both(&[("f2", "index")])?;
    let f1 = section.required("f1", "the first derivative of the frequency of the pulses at the epoch [Hz/s]")?;
    let f1 = f1.number_where("nonzero and from -1e-3 to 1e-3 [Hz/s]", |f1| f1 != 0.0 && f1.abs() <= 1e-3)?;
    let index = match (section.optional("f2"), section.optional("index")) {
        (Some(second), _) => IndexOrSecond::Second(second.number_in("from -1e-9 to 1e-9 [Hz/s^2]", -1e-9..=1e-9)?),
        (None, Some(index)) => IndexOrSecond::Index(index.number_in("from -30 to 30", -30.0..=30.0)?),
        (None, None) => IndexOrSecond::Index(3.0),
    };
    let torque_share = match section.optional("torque") {
        None => 0.0,
        Some(entry) => {
            let allowed =
                "\"constant\", \"plasma\", \"vacuum\", or the share of sin^2 theta_m in the torque, from 0 to 1";
            let named = entry.string().ok().map(|name| TORQUES.iter().find(|(of, _)| *of == name));
            match named {
                Some(found) => found.map(|(_, share)| *share).ok_or_else(|| entry.refuse(allowed))?,
                None => entry.number_in(allowed, 0.0..=1.0)?,
            }
        }
    };
    let damping_time = match section.optional("damping_time") {
        None => None,
        Some(_) if index != IndexOrSecond::Index(3.0) => {
            return Err(section.fault("`damping_time` is only for a braking index of 3; use `index = 3` without `f2`"));
        }
        Some(entry) => Some(entry.number_in("from 1e-3 to 1e12 [d]", 1e-3..=1e12)? * DAY),
    };
    Ok(SpinDown { f1, index, torque_share, damping_time })
}
