//! The sections that define the observation: `[observer]`, `[pulsar]`, `[time]` and `[output]`.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Vector3;
use twofold::epoch::{DAY, Epoch};
use twofold::observables::Observer;
use twofold::observables::pulsar::Beam;
use twofold::plan::{Method, Output};
use twofold::units::JULIAN_YEAR;
use twofold::units::si::KILOPARSEC;

use super::Scene;
use super::document::{Entry, Section};
use super::fault::Fault;
use super::motion::{Units, outwards};
use super::names::{did_you_mean, listed};

/// Direction and distance of the observer, in the inertial frame of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewer {
    /// Colatitude `theta_o` (rad).
    pub theta_o: f64,
    /// Azimuth `phi_o` (rad).
    pub phi_o: f64,
    /// Distance of a physical star in m, if given.
    pub distance: Option<f64>,
}

impl Viewer {
    /// The direction to the observer and the basis normal to it, Eqs. (46), (70).
    pub fn basis(&self) -> Observer<f64> {
        Observer::at(self.theta_o, self.phi_o)
    }
}

/// The radiation of a scene's star.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulsar {
    /// Angle `chi` of the magnetic axis to the symmetry axis (rad).
    pub chi: f64,
    /// Azimuth `delta` of the magnetic axis in the body (rad).
    pub delta: f64,
    /// Semi-open angle `rho` of the beam (rad).
    pub rho: f64,
    /// Whether the pulses of the opposite beam are requested too.
    pub second_beam: bool,
}

impl Pulsar {
    /// The beam about the magnetic axis, Eq. (45).
    pub fn beam(&self) -> Beam<f64> {
        Beam::new(self.chi, self.delta, self.rho)
    }
}

/// A catalogued pulsar.
#[derive(Debug, Clone, PartialEq)]
pub struct Catalogued {
    /// Name.
    pub name: String,
    /// Right ascension (J2000), as `19:39:38.56`, and declination, as `+21:34:59.1`.
    pub position: Option<(Sexagesimal, Sexagesimal)>,
}

/// An angle in the notation of catalogues.
#[derive(Debug, Clone, PartialEq)]
pub struct Sexagesimal {
    /// As written.
    pub text: String,
    /// In rad.
    pub angle: f64,
}

impl Sexagesimal {
    /// Reads an integer, minutes and decimal seconds, in total at most `most` units of `degrees` degrees each.
    fn read(text: &str, most: f64, degrees: f64) -> Option<Self> {
        let above = text.strip_prefix('+').unwrap_or(text);
        let (sign, size) = text.strip_prefix('-').map_or((1.0, above), |below| (-1.0, below));
        let parts: Vec<_> = size.split(':').collect();
        let [whole, minutes, seconds] = parts[..] else { return None };
        let plain = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
        let below = |part: &str| part.parse().ok().filter(|x: &f64| plain(part) && *x < 60.0);
        let whole: u8 = whole.parse().ok().filter(|_| plain(whole))?;
        let minutes = below(minutes).filter(|_| minutes.len() == 2)?;
        let units = f64::from(whole) + (minutes + below(seconds)? / 60.0) / 60.0;
        let angle = sign * units * degrees;
        (units <= most).then(|| Self { text: text.to_owned(), angle: angle.to_radians() })
    }
}

/// The observer of a star with the angular momentum along `l` (a unit vector); `l` is arbitrary if the star has none.
pub(super) fn read_observer(
    section: &Section<'_>,
    units: &Units,
    l: Option<Vector3<f64>>,
    catalogued: Option<&Catalogued>,
) -> Result<Viewer, Fault> {
    section.only("theta_o phi_o inclination azimuth frame distance")?;
    section.not_both(&[("theta_o", "inclination"), ("theta_o", "frame"), ("inclination", "frame")])?;
    section.not_both(&[("phi_o", "inclination"), ("phi_o", "frame"), ("azimuth", "theta_o"), ("azimuth", "frame")])?;
    let (theta_o, phi_o) = if let Some(entry) = section.optional("inclination") {
        let inclination = entry.angle_where("an angle from 0 to pi [rad]", |x| (0.0..=PI).contains(&x))?;
        let azimuth = section.optional("azimuth").map_or(Ok(0.0), |entry| entry.angle())?;
        let l = l.ok_or_else(|| {
            entry.refuse_because("the star has no angular momentum, from which the inclination is measured")
        })?;
        angles_of(&(l * inclination.cos() + outwards(&l, azimuth) * inclination.sin()))
    } else if let Some(entry) = section.optional("frame") {
        if entry.string()? != "equatorial" {
            return Err(entry.refuse("\"equatorial\", with X to the equinox and Z to the north pole of the sky"));
        }
        let position = catalogued.and_then(|catalogued| catalogued.position.as_ref());
        let (ascension, declination) = position.ok_or_else(|| {
            entry.refuse_because(
                "requires `pulsar.right_ascension` and `pulsar.declination`; the observer is in the opposite direction",
            )
        })?;
        // From the star to the observer.
        (FRAC_PI_2 + declination.angle, (ascension.angle + PI) % TAU)
    } else {
        let theta_o = section
            .required(
                "theta_o",
                "colatitude of the observer [rad], or `observer.inclination` to L, or `observer.frame`",
            )?
            .angle_where("an angle from 0 to pi [rad]", |x| (0.0..=PI).contains(&x))?;
        (theta_o, section.required("phi_o", "azimuth of the observer [rad]")?.angle()?)
    };
    let distance = match section.optional("distance") {
        Some(entry) if !units.are_physical() => {
            return Err(
                entry.refuse_because("a distance is only for a physical star; in the paper's units h is that at r = 1")
            );
        }
        Some(entry) => Some(entry.number_in("a distance from 1e-6 to 1e8 [kpc]", 1e-6..=1e8)? * KILOPARSEC),
        None => None,
    };
    Ok(Viewer { theta_o, phi_o, distance })
}

/// Colatitude and azimuth of a direction.
fn angles_of(direction: &Vector3<f64>) -> (f64, f64) {
    (direction.x.hypot(direction.y).atan2(direction.z), direction.y.atan2(direction.x))
}

pub(super) fn read_pulsar(section: &Section<'_>) -> Result<Pulsar, Fault> {
    section.only("chi delta rho second_beam name right_ascension declination")?;
    Ok(Pulsar {
        chi: section
            .required("chi", "angle of the magnetic axis to the symmetry axis [rad]")?
            .angle_where("an angle from 0 to pi [rad]", |x| (0.0..=PI).contains(&x))?,
        delta: section.optional("delta").map_or(Ok(0.0), |entry| entry.angle())?,
        rho: section
            .required("rho", "semi-open angle of the beam [rad]")?
            .angle_where("an angle above 0 and below pi [rad]", |x| x > 0.0 && x < PI)?,
        second_beam: section.optional("second_beam").map_or(Ok(false), |entry| entry.boolean())?,
    })
}

/// The name that files for timing programs give to a pulsar without a name.
pub(crate) const NAMELESS: &str = "PULSAR";

pub(super) fn read_catalogued(section: &Section<'_>) -> Result<Option<Catalogued>, Fault> {
    let is_name = |name: &str| !name.is_empty() && name.chars().all(|c| c.is_ascii_graphic());
    let name = match section.optional("name") {
        Some(name) if !is_name(name.string()?) => return Err(name.refuse("a name without spaces")),
        Some(name) => Some(name.string()?.to_owned()),
        None => None,
    };
    let position = match (section.optional("right_ascension"), section.optional("declination")) {
        (None, None) => None,
        (Some(_), None) => return Err(section.missing("`pulsar.declination`, required by `pulsar.right_ascension`")),
        (None, Some(_)) => return Err(section.missing("`pulsar.right_ascension`, required by `pulsar.declination`")),
        (Some(ascension), Some(declination)) => {
            let hours = Some(ascension.string()?).filter(|text| !text.starts_with(['+', '-']));
            let right = hours.and_then(|text| Sexagesimal::read(text, 24.0, 15.0));
            let right = right.ok_or_else(|| ascension.refuse("hours, minutes and seconds, such as \"19:39:38.56\""))?;
            let up = Sexagesimal::read(declination.string()?, 90.0, 1.0);
            Some((
                right,
                up.ok_or_else(|| declination.refuse("degrees, minutes and seconds, such as \"+21:34:59.1\""))?,
            ))
        }
    };
    let is_catalogued = name.is_some() || position.is_some();
    Ok(is_catalogued.then(|| Catalogued { name: name.unwrap_or_else(|| NAMELESS.to_owned()), position }))
}

/// Largest number of samples of a scene, and of arrival times.
pub const MOST_SAMPLES: usize = 10_000_000;

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
    /// As given in a list.
    Listed {
        /// Time at which the initial values hold.
        start: f64,
        /// Times, in order away from `start`.
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

    /// Number of times.
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

/// Reads the section `[time]` of a scene: it may contain an epoch and, for a physical star, a span in years.
pub(super) fn read_time(section: &Section<'_>, units: &Units) -> Result<Times, Fault> {
    section.only("epoch start years span end samples times")?;
    let Some(years) = section.optional("years") else { return read_times(section) };
    section.not_both(&[("span", "years"), ("end", "years"), ("times", "years")])?;
    if !units.are_physical() {
        return Err(years.refuse_because("a span in years is only for a physical star; use `time.span`, in t_c"));
    }
    let start = section.number_or("start", 0.0)?;
    let span =
        years.number_where("a nonzero number of Julian years from -1e6 to 1e6", |x| x != 0.0 && x.abs() <= 1e6)?;
    even_times(section, &years, start, start + span * JULIAN_YEAR)
}

/// The epoch of the start, a modified Julian date; and a caution if it looks like another kind of date.
pub(super) fn read_epoch(
    section: &Section<'_>,
    units: &Units,
    times: &Times,
) -> Result<Option<(Epoch, Option<String>)>, Fault> {
    let Some(entry) = section.optional("epoch") else { return Ok(None) };
    if !units.are_physical() {
        return Err(entry.refuse_because("an epoch is only for a physical star, whose times are in seconds"));
    }
    let allowed = "a modified Julian date from 0 to 1e7, such as 55321.25, or in quotes with more digits";
    let text = if entry.is_string() { entry.string()?.to_owned() } else { entry.number()?.to_string() };
    let epoch: Epoch = text.parse().map_err(|_| entry.refuse(allowed))?;
    let span = times.last() - times.start();
    if epoch.after([span, 0.0]).is_err() {
        let days = span / DAY;
        return Err(section.fault(format!(
            "[time] ends {days:.3e} days from its epoch: must be at most 1e9 days in either direction with `time.epoch`"
        )));
    }
    let caution = like_julian_date(&epoch).map(|why| entry.refuse_because(&why).message);
    Ok(Some((epoch, caution)))
}

/// A caution for an epoch that would be a contemporary date if it were meant as a Julian date.
pub fn like_julian_date(epoch: &Epoch) -> Option<String> {
    // The years 1858 to 2132.
    if !(2_400_000..2_500_000).contains(&epoch.day()) {
        return None;
    }
    // MJD = JD - 2400000.5.
    let meant = Epoch::new(epoch.day() - 2_400_000, epoch.fraction() - 0.5).ok()?;
    let year = 1858.9 + epoch.day() as f64 / 365.2425;
    Some(format!(
        "looks like a Julian date; a modified Julian date is expected, and this one is in the year {year:.0}. If {meant} is meant, \
         write that"
    ))
}

/// Times in equal steps, or as listed.
pub(crate) fn read_times(section: &Section<'_>) -> Result<Times, Fault> {
    section.not_both(&[("span", "end"), ("times", "span"), ("times", "end"), ("times", "samples")])?;
    let start = section.number_or("start", 0.0)?;
    if section.has("times") {
        return listed_times(section, start);
    }
    let (end, entry) = read_end(section, start)?;
    even_times(section, &entry, start, end)
}

/// The end of the span, with the entry that defines it.
pub(crate) fn read_end<'a>(section: &Section<'a>, start: f64) -> Result<(f64, Entry<'a>), Fault> {
    match (section.optional("span"), section.optional("end")) {
        (Some(span), _) => Ok((start + span.number_where("a number other than zero", |x| x != 0.0)?, span)),
        (None, Some(end)) => Ok((end.number_where("a number other than `time.start`", |x| x != start)?, end)),
        (None, None) => Err(section.missing("one of `time.span`, `time.end` and `time.times`")),
    }
}

/// Times in equal steps up to an end that follows from `entry`.
fn even_times(section: &Section<'_>, entry: &Entry<'_>, start: f64, end: f64) -> Result<Times, Fault> {
    let samples = section.required("samples", "number of rows, both ends included")?.whole_number(2, MOST_SAMPLES)?;
    // Rows must differ in time: a span that is lost in the rounding of its ends has no even spacing.
    let spacing = (end - start).abs() / (samples - 1) as f64;
    if !(spacing.is_finite() && spacing > 4.0 * f64::EPSILON * start.abs()) {
        return Err(entry.refuse("a span whose samples differ from one another in double precision"));
    }
    Ok(Times::Even { start, end, samples })
}

fn listed_times(section: &Section<'_>, start: f64) -> Result<Times, Fault> {
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
            return Err(entry
                .refuse("beyond the time before it; times must increase or decrease strictly away from `time.start`"));
        }
        previous = time;
    }
    Ok(Times::Listed { start, times })
}

pub(super) const DEFAULT_TOLERANCE: f64 = 1e-13;

/// The groups of columns of a table, in order, with their names in a scene file. Every scene has the first six, those of the motion.
pub const COLUMN_GROUPS: [(&str, Output); 12] = [
    ("angles", Output::EulerAngles),
    ("rates", Output::EulerRates),
    ("e_x", Output::EquatorialAxis),
    ("e_z", Output::SymmetryAxis),
    ("L", Output::AngularMomentum),
    ("integrals", Output::FirstIntegrals),
    ("perturbation", Output::PerturbationAngles),
    ("lambda", Output::SpinAxisAngle),
    ("m.n", Output::PulseProfile),
    ("magnetic_axis", Output::MagneticAxis),
    ("position_angle", Output::PositionAngle),
    ("h", Output::GravitationalWave),
];

pub(super) fn columns_of_the_motion() -> Vec<Output> {
    COLUMN_GROUPS[..6].iter().map(|(_, output)| *output).collect()
}

/// The group of columns called `name`.
pub fn column_group(name: &str) -> Option<Output> {
    COLUMN_GROUPS.iter().find(|(known, _)| *known == name).map(|(_, output)| *output)
}

/// The groups `wanted` in the order of the table.
pub(crate) fn in_table_order(wanted: &[Output]) -> Vec<Output> {
    COLUMN_GROUPS.iter().map(|(_, output)| *output).filter(|output| wanted.contains(output)).collect()
}

/// Reads columns and tolerance into an otherwise complete scene. The scene keeps its columns if those of the file are not `used`.
pub(super) fn read_output(section: &Section<'_>, scene: &mut Scene, used: bool) -> Result<(), Fault> {
    section.only("columns tolerance method")?;
    read_tolerance_and_method(section, scene)?;
    let Some(list) = section.optional("columns") else { return Ok(()) };
    let names = COLUMN_GROUPS.map(|(name, _)| name);
    let words = list.words(&names)?;
    if words.is_empty() {
        return Err(list.refuse(&format!("a list of different names from \"{}\"", names.join("\", \""))));
    }
    if used {
        scene.columns = columns_in(&words, scene)?;
    }
    Ok(())
}

/// The groups of columns among the words of a list, if the scene has the sections from which they are computed.
pub(crate) fn columns_in(words: &[(Entry<'_>, &str)], scene: &Scene) -> Result<Vec<Output>, Fault> {
    let mut wanted = Vec::new();
    for (entry, name) in words {
        if let Some(output) = column_group(name) {
            scene.has_what_is_needed_for(output).map_err(|why| entry.refuse_because(&why))?;
            wanted.push(output);
        }
    }
    Ok(in_table_order(&wanted))
}

/// Reads the keys `tolerance` and `method` into a scene, which keeps its values if they are not given.
pub(crate) fn read_tolerance_and_method(section: &Section<'_>, scene: &mut Scene) -> Result<(), Fault> {
    if let Some(entry) = section.optional("tolerance") {
        scene.tolerance = entry.number_in("a number from 1e-14 to 1e-2", 1e-14..=1e-2)?;
    }
    if let Some(entry) = section.optional("method") {
        let name = entry.word(&Method::ALL.map(Method::name))?;
        scene.choose_method(name).map_err(|why| entry.refuse_because(&why))?;
    }
    Ok(())
}

impl Scene {
    /// Forces the method called `name` instead of the cheapest one.
    pub fn choose_method(&mut self, name: &str) -> Result<(), String> {
        self.method = Some(Method::named(name).ok_or_else(|| unknown(name, "method", &Method::ALL.map(Method::name)))?);
        self.plan(&[Output::EquatorialAxis])
            .map(|_| ())
            .map_err(|why| format!("the scene does not allow this method: {why}"))
    }

    /// Replaces the columns by the groups called `names`.
    pub fn choose_columns(&mut self, names: &[&str]) -> Result<(), String> {
        let mut wanted = Vec::new();
        for &name in names {
            let known = COLUMN_GROUPS.map(|(name, _)| name);
            let output = column_group(name).ok_or_else(|| unknown(name, "group of columns", &known))?;
            if wanted.contains(&output) {
                return Err(format!("`{name}` is given twice"));
            }
            self.has_what_is_needed_for(output).map_err(|why| format!("`{name}`: {why}"))?;
            wanted.push(output);
        }
        if wanted.is_empty() {
            return Err("expected at least one group of columns".into());
        }
        self.columns = in_table_order(&wanted);
        Ok(())
    }

    /// Whether the scene has the sections from which an output is computed.
    pub fn has_what_is_needed_for(&self, output: Output) -> Result<(), String> {
        let no_observer = self.observer.is_none().then(|| "the section [observer]".to_owned());
        let no_pulsar = self.pulsar.is_none().then(|| "the section [pulsar]".to_owned());
        let lacking = match output {
            Output::PerturbationAngles => {
                [self.perturbation.as_ref().err().map(|why| format!("a perturbation solution: {why}")), None]
            }
            Output::SpinAxisAngle => [no_observer, None],
            Output::PulseProfile | Output::PositionAngle | Output::Pulses => [no_observer, no_pulsar],
            Output::MagneticAxis => [no_pulsar, None],
            Output::GravitationalWave => [
                no_observer,
                self.lacks_distance()
                    .then(|| "`observer.distance` [kpc], without which a physical star has no strain".to_owned()),
            ],
            _ => [None, None],
        };
        let lacking: Vec<_> = lacking.into_iter().flatten().collect();
        if lacking.is_empty() { Ok(()) } else { Err(format!("the scene lacks {}", lacking.join(" and "))) }
    }

    fn lacks_distance(&self) -> bool {
        self.units.are_physical() && self.observer.is_some_and(|observer| observer.distance.is_none())
    }
}

fn unknown(name: &str, what: &str, known: &[&str]) -> String {
    format!("`{name}` is not a {what}; expected one of {}.{}", listed(known), did_you_mean(name, known))
}
