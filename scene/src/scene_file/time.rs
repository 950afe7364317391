//! The section `[time]`.

use twofold::epoch::{DAY, Epoch};
use twofold::units::JULIAN_YEAR;

use super::error::Fault;
use super::section::Section;
use super::star::Units;

/// Most rows of output.
pub(crate) const MOST_SAMPLES: usize = 10_000_000;

/// Times of the output, strictly increasing or strictly decreasing, in units of the output.
#[derive(Debug, Clone, PartialEq)]
pub enum Times {
    /// Equally spaced, both ends included.
    Even {
        /// First time; the initial values hold there.
        start: f64,
        /// Last time.
        end: f64,
        /// Number of times, at least two.
        samples: usize,
    },
    /// As listed.
    Listed {
        /// Time at which the initial values hold.
        start: f64,
        /// Times, leading away from `start`.
        times: Vec<f64>,
    },
}

impl Times {
    /// Time at which the initial values hold.
    pub fn start(&self) -> f64 {
        match self {
            Times::Even { start, .. } | Times::Listed { start, .. } => *start,
        }
    }

    /// Last time.
    pub fn last(&self) -> f64 {
        match self {
            Times::Even { end, .. } => *end,
            Times::Listed { times, .. } => times[times.len() - 1],
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        match self {
            Times::Even { samples, .. } => *samples,
            Times::Listed { times, .. } => times.len(),
        }
    }

    /// All times in order.
    pub fn iter(&self) -> Box<dyn Iterator<Item = f64> + '_> {
        match self {
            Times::Even { start, end, samples } => {
                let (start, end, last) = (*start, *end, *samples - 1);
                Box::new((0..=last).map(move |i| {
                    let part = i as f64 / last as f64;
                    if i == last { end } else { start + (end - start) * part }
                }))
            }
            Times::Listed { times, .. } => Box::new(times.iter().copied()),
        }
    }
}

/// As [`read`], with an epoch, and a span in years, for a physical star.
pub(super) fn read_with_years(section: &Section<'_>, units: &Units) -> Result<Times, Fault> {
    section.only(&["epoch", "start", "years", "span", "end", "samples", "times"])?;
    let Some(years) = section.optional("years") else { return read_listed_or_even(section) };
    for other in ["span", "end", "times"] {
        section.not_both(other, "years")?;
    }
    if !units.are_physical() {
        return Err(years.refuse("a span in years only for a physical star; `time.span` is in t_c"));
    }
    let start = section.optional("start").map_or(Ok(0.0), |entry| entry.number())?;
    let span =
        years.number_where("a number of Julian years from -1e6 to 1e6, not zero", |x| x != 0.0 && x.abs() <= 1e6)?;
    let samples = section.required("samples", "number of rows, both ends included")?.whole_number(2, MOST_SAMPLES)?;
    Ok(Times::Even { start, end: start + span * JULIAN_YEAR, samples })
}

/// The epoch of the start, a modified Julian date, a number or a string with all its digits; and a sentence if it looks like another
/// kind of date.
pub(super) fn read_epoch(
    section: &Section<'_>,
    units: &Units,
    times: &Times,
) -> Result<Option<(Epoch, Option<String>)>, Fault> {
    let Some(entry) = section.optional("epoch") else { return Ok(None) };
    if !units.are_physical() {
        return Err(entry.refuse("an epoch only for a physical star, whose times are in seconds"));
    }
    let allowed = "a modified Julian date from 0 to 1e7, as 55321.25 or in quotes with more digits";
    let text = if entry.is_string() { entry.string()?.to_owned() } else { entry.number()?.to_string() };
    let epoch: Epoch = text.parse().map_err(|_| entry.refuse(allowed))?;
    let span = times.last() - times.start();
    if epoch.after([span, 0.0]).is_err() {
        let days = span / DAY;
        return Err(section.fault(format!(
            "[time] ends {days:.3e} days from its epoch: allowed beside `time.epoch` are at most 1e9 days, either way"
        )));
    }
    let caution = like_julian_date(&epoch).map(|why| entry.refuse_because(&why).message);
    Ok(Some((epoch, caution)))
}

/// A sentence about an epoch that is a date of our time if it is meant as a Julian date.
pub fn like_julian_date(epoch: &Epoch) -> Option<String> {
    // The years 1858 to 2132.
    if !(2_400_000..2_500_000).contains(&epoch.day()) {
        return None;
    }
    // MJD = JD - 2400000.5.
    let meant = Epoch::new(epoch.day() - 2_400_001, epoch.fraction() + 0.5).ok()?;
    let year = 1858.9 + epoch.day() as f64 / 365.2425;
    Some(format!(
        "looks like a Julian date; a modified Julian date is asked for, and this one is in the year {year:.0}. If {meant} is meant, \
         write that"
    ))
}

pub(crate) fn read(section: &Section<'_>) -> Result<Times, Fault> {
    section.only(&["start", "span", "end", "samples", "times"])?;
    read_listed_or_even(section)
}

fn read_listed_or_even(section: &Section<'_>) -> Result<Times, Fault> {
    for (first, second) in [("span", "end"), ("times", "span"), ("times", "end"), ("times", "samples")] {
        section.not_both(first, second)?;
    }
    let start = section.optional("start").map_or(Ok(0.0), |entry| entry.number())?;
    if section.has("times") { listed(section, start) } else { even(section, start) }
}

fn even(section: &Section<'_>, start: f64) -> Result<Times, Fault> {
    let (end, entry) = match (section.optional("span"), section.optional("end")) {
        (Some(span), _) => (start + span.number_where("any number except zero", |x| x != 0.0)?, span),
        (None, Some(end)) => (end.number_where("any number except `time.start`", |x| x != start)?, end),
        (None, None) => return Err(section.missing("one of `time.span`, `time.end` and `time.times`")),
    };
    let samples = section.required("samples", "number of rows, both ends included")?.whole_number(2, MOST_SAMPLES)?;
    // Rows must differ in time: a span that is lost in the rounding of its ends has no even spacing.
    let spacing = (end - start).abs() / (samples - 1) as f64;
    if !(spacing.is_finite() && spacing > 4.0 * f64::EPSILON * start.abs().max(end.abs())) {
        return Err(entry.refuse("a span whose samples differ from one another in double precision"));
    }
    Ok(Times::Even { start, end, samples })
}

fn listed(section: &Section<'_>, start: f64) -> Result<Times, Fault> {
    let allowed = "a list of 1 to 10000000 numbers, strictly increasing or strictly decreasing away from `time.start`";
    let list = section.required("times", "times of the rows")?;
    let entries = list.list(allowed)?;
    if entries.is_empty() || entries.len() > MOST_SAMPLES {
        return Err(list.refuse(allowed));
    }
    let times = entries.iter().map(|entry| entry.number()).collect::<Result<Vec<_>, _>>()?;
    let backwards = times[times.len() - 1] < start;
    let mut previous = start;
    for (i, (&time, entry)) in times.iter().zip(&entries).enumerate() {
        let onward = if backwards { time < previous } else { time > previous };
        if !(onward || (i == 0 && time == start)) {
            return Err(entry.refuse("times strictly increasing or strictly decreasing away from `time.start`"));
        }
        previous = time;
    }
    Ok(Times::Listed { start, times })
}
