//! Kinds of data, and measured values.

use super::{Event, Signal};
use crate::error::Error;

/// A kind of data. Errors of different data are independent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Observable {
    /// Times of the midpoints of whole pulses.
    Arrivals,
    /// Times at which the magnetic axis is nearest to the line of sight.
    ClosestApproaches,
    /// Durations of whole pulses.
    Widths,
    /// Times between the midpoints of pulses of consecutive turns, each measured independently. They are not differences of
    /// measured arrival times, whose errors are correlated and which contain less information than the arrival times themselves.
    Periods,
    /// `h_+` at samples.
    StrainPlus,
    /// `h_x` at samples.
    StrainCross,
}

impl Observable {
    /// All kinds.
    pub const ALL: [Self; 6] =
        [Self::Arrivals, Self::ClosestApproaches, Self::Widths, Self::Periods, Self::StrainPlus, Self::StrainCross];

    /// Name in commands.
    pub fn key(self) -> &'static str {
        match self {
            Self::Arrivals => "arrivals",
            Self::ClosestApproaches => "closest_approaches",
            Self::Widths => "widths",
            Self::Periods => "periods",
            Self::StrainPlus => "h_plus",
            Self::StrainCross => "h_cross",
        }
    }

    /// Whether data of this kind need every turn to be followed, which is possible for up to 1e5 rad of rotation.
    pub fn is_of_every_turn(self) -> bool {
        matches!(self, Self::ClosestApproaches | Self::Periods)
    }

    /// Whether data of this kind are times taken from the pulses of a beam.
    pub fn is_of_pulses(self) -> bool {
        !matches!(self, Self::StrainPlus | Self::StrainCross)
    }
}

/// A kind of data with its standard deviation: in `t_c` for times, in the unit of the model for strains.
pub type Noise = (Observable, f64);

/// Position of a datum in a signal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// A turn, counted from an arbitrary origin, with the approximate time of its pulse.
    Turn {
        /// Number of the turn.
        number: i64,
        /// Approximate time, to a tenth of a turn.
        near: f64,
    },
    /// A time.
    Time(f64),
}

/// One measured value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Datum {
    /// What is measured.
    pub observable: Observable,
    /// The pulse or time that it belongs to.
    pub place: Place,
    /// Time from which an arrival or a closest approach is counted: see [`Event::epoch`].
    pub epoch: f64,
    /// The measured value.
    pub value: f64,
    /// Its standard deviation.
    pub sigma: f64,
}

/// The data without errors for the kinds in `noise`: from the pulses `events`, and from the strain at `samples`.
///
/// # Errors
/// A motion that cannot be evaluated at a sample; closest approaches and periods over a [long](Signal::is_long) span.
pub fn data_of(signal: &Signal, events: &[Event], samples: &[f64], noise: &[Noise]) -> Result<Vec<Datum>, Error> {
    let mut data = Vec::new();
    Error::ensure(
        !(signal.is_long && noise.iter().any(|(kind, _)| kind.is_of_every_turn())),
        "span for closest approaches and periods",
        signal.end,
        "so short that the star turns by at most 1e5 rad; arrivals and widths have no such limit",
    )?;
    for &(observable, sigma) in noise {
        if observable.is_of_pulses() {
            for (i, event) in events.iter().enumerate() {
                let before = i.checked_sub(1).map(|before| events[before]);
                if let Some(value) = event.value(before.as_ref(), observable) {
                    let place = Place::Turn { number: event.turn, near: event.epoch + event.midpoint() };
                    let is_time = matches!(observable, Observable::Arrivals | Observable::ClosestApproaches);
                    let epoch = if is_time { event.epoch } else { 0.0 };
                    data.push(Datum { observable, place, epoch, value, sigma });
                }
            }
        } else {
            for &time in samples {
                let value = signal.strain(observable, time)?;
                data.push(Datum { observable, place: Place::Time(time), epoch: 0.0, value, sigma });
            }
        }
    }
    Ok(data)
}
