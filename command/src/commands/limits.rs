//! `twofold limits`.

use std::f64::consts::TAU;

use clap::Args;
use twofold::epoch::DAY;
use twofold::inference::{
    Fit, InferenceError, Observable, Prior, Residuals, TimingData, fit_timing, timing_nonlinearity, wobble_limits,
};
use twofold::nalgebra::Vector3;
use twofold::observables::bound::preferred_frame_bound;
use twofold::observables::pulsar::timing_model::{TimingModel, TimingParameter};
use twofold::units::geometrised::KILOMETRE;
use twofold_scene::measurements::{named, parse_noise, read_timing};
use twofold_scene::pulsar_table::{CONFIDENCE, limit_over_directions};
use twofold_scene::pulsar_timing::{PulsarScene, decimal};
use twofold_scene::scene_file::Columns;
use twofold_scene::significant::significant;

use super::measurement::{note_nonlinearity, readable, uncertainties, write_csv};
use super::run::read_with_spin_down;
use super::timing::days_apart;
use super::{Failure, TableArgs, counted, note, print};

#[derive(Args)]
pub(crate) struct LimitsArgs {
    /// A built-in pulsar (see `twofold scenes`) or the path of a scene file (TOML), with `time.epoch`, [observer] and [pulsar]: the starting values of the fit, and the values held fixed
    pub(crate) scene: String,
    /// Barycentred arrival times (.tim, FORMAT 1), or tables as `twofold timing` writes them
    #[arg(value_name = "DATA", required = true)]
    pub(crate) data: Vec<String>,
    /// The observables of tables, each with its standard deviation in seconds: arrivals, widths. A .tim states its own errors
    #[arg(long, value_name = "NAME:SIGMA,NAME:SIGMA")]
    pub(crate) observe: Option<String>,
    /// Parameters to fit: phase, f0, f1, f2, wobble, damping, chi, precession_phase, precession_rate, torque_share, inclination,
    /// inclination_rate, rho; or all. If not given: phase, f0 and f1 of arrivals, inclination_rate and rho of widths
    #[arg(long, value_name = "NAME,NAME")]
    pub(crate) parameters: Option<String>,
    /// Normal prior of a parameter: its mean and standard deviation, as chi:1.2:0.05; may be given more than once
    #[arg(long, value_name = "NAME:MEAN:SIGMA", value_parser = prior)]
    pub(crate) prior: Vec<Prior>,
    /// Periods of free precession (days) at which to limit the wobble, spaced logarithmically from the first to the last; --out then writes these limits
    #[arg(long, value_name = "FIRST:LAST:NUMBER", value_parser = periods)]
    pub(crate) periods: Option<Periods>,
    #[command(flatten)]
    pub(crate) output: TableArgs,
}

/// Speed (km/s) of the Sun relative to the cosmic microwave background: Hinshaw et al., Astrophys. J. Suppl. 180, 225 (2009).
const SPEED: f64 = 369.0;

/// Periods with equal ratios (d).
#[derive(Clone, Copy)]
pub(crate) struct Periods {
    first: f64,
    last: f64,
    pub(crate) number: usize,
}

impl Periods {
    fn rates(self) -> Vec<f64> {
        let ratio = (self.last / self.first).ln() / (self.number.max(2) - 1) as f64;
        (0..self.number).map(|k| TAU / (self.first * (ratio * k as f64).exp() * DAY)).collect()
    }
}

fn periods(text: &str) -> Result<Periods, String> {
    let wrong = || {
        "must be two periods from 1e-6 to 1e9 days and their number from 1 to 10000, such as 50:5000:40; equal periods only with the number 1"
            .to_owned()
    };
    let [first, last, number] = text.split(':').collect::<Vec<_>>()[..] else { return Err(wrong()) };
    let day = |text: &str| text.parse().ok().filter(|day: &f64| (1e-6..=1e9).contains(day)).ok_or_else(wrong);
    let number = number.parse().ok().filter(|number| (1..=10_000).contains(number)).ok_or_else(wrong)?;
    let (first, last) = (day(first)?, day(last)?);
    if first == last && number > 1 { Err(wrong()) } else { Ok(Periods { first, last, number }) }
}

fn prior(text: &str) -> Result<Prior, String> {
    let wrong =
        || "must be a parameter, its mean and its standard deviation, at least 1e-100, such as chi:1.2:0.05".to_owned();
    let [name, mean, sigma] = text.split(':').collect::<Vec<_>>()[..] else { return Err(wrong()) };
    let number = |text: &str| text.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(wrong);
    let [parameter] = named(name, &TimingParameter::ALL)?[..] else { return Err(wrong()) };
    let (mean, sigma) = (number(mean)?, number(sigma)?);
    if sigma >= 1e-100 { Ok(Prior { parameter, mean, sigma }) } else { Err(wrong()) }
}

pub(super) fn run(args: &LimitsArgs) -> Result<(), Failure> {
    use TimingParameter::{InclinationRate, Phase, Rho};
    let scene = read_with_spin_down(&args.scene, Columns::Unused)?;
    let refuse = |why: String| Failure::BadInput(format!("{}: {why}", args.scene));
    let pulsar = PulsarScene::new(&scene).map_err(refuse)?;
    let start = pulsar.clock.timing_model()?;
    let data = read(args, &pulsar, &start)?;
    let unknowns = match args.parameters.as_deref() {
        Some(list) => named(list, &TimingParameter::ALL).map_err(|why| refuse(format!("--parameters: {why}")))?,
        None => {
            let of_arrivals =
                [Phase, TimingParameter::F0, TimingParameter::F1].into_iter().filter(|_| !data.arrivals.is_empty());
            of_arrivals.chain([InclinationRate, Rho].into_iter().filter(|_| !data.widths.is_empty())).collect()
        }
    };
    if let Some(prior) = data.priors.iter().find(|prior| !unknowns.contains(&prior.parameter)) {
        let key = prior.parameter.key();
        return Err(refuse(format!("--prior {key}: must be a fitted parameter; {key} is not in --parameters")));
    }
    let refused = |error: InferenceError| match error {
        InferenceError::Model(error) => error.into(),
        error @ InferenceError::TooFew { .. } => Failure::BadInput(format!("{}: {error}", args.data.join(", "))),
        error => Failure::Failed(format!("{}: {error}", args.scene)),
    };
    if let Some(periods) = args.periods {
        if data.arrivals.is_empty() {
            let files = args.data.join(", ");
            return Err(Failure::BadInput(format!(
                "--periods: there is no arrival time in {files}; use data with arrival times"
            )));
        }
        check_periods(periods, &start, &data)?;
        // A scene, unknowns or data that the limits would refuse are refused before the fit.
        wobble_limits(&start, &data, &unknowns, &[], CONFIDENCE).map_err(|error| match error {
            InferenceError::TooFew { .. } => refused(error),
            error => refuse(error.to_string()),
        })?;
    }
    let found = fit_timing(&start, &data, &unknowns).map_err(refused)?;
    let model = &found.fisher.parameters;
    let [short, mut all] = uncertainties(&found.fisher, |unknown| (1.0, unknown.unit().to_owned()));
    // F0 as one double is wrong by a turn in 1e16.
    if let Some(row) = all.iter_mut().find(|row| row[0] == TimingParameter::F0.key()) {
        row[1] = decimal(model.frequency());
    }
    tell_fit(&found, &data, &pulsar);
    let mut page = readable(&short);
    let mut tables = all;
    let are_larger = found.consistency() == Residuals::Larger;
    if unknowns.contains(&InclinationRate) && !are_larger {
        page += &limit_on_s(&found)?;
    }
    if args.periods.is_some() && are_larger {
        print(&(page + &assumptions(model, &unknowns, &data)))?;
        return Err(Failure::Failed(format!(
            "{}: --periods: no limits, because the residuals are larger than the errors",
            args.scene
        )));
    }
    if let Some(periods) = args.periods {
        let limits = wobble_limits(model, &data, &unknowns, &periods.rates(), CONFIDENCE).map_err(refused)?;
        let head = ["period [d]", "best wobble [rad]", "gain of chi^2", "limit of the wobble [rad]"]
            .map(String::from)
            .to_vec();
        let (mut rows, mut plain) = (vec![head.clone()], vec![head]);
        for limit in &limits {
            let values = [TAU / limit.precession_rate / DAY, limit.best, limit.gain, limit.limit];
            let either = |finite: &dyn Fn(f64) -> String, other: &str| -> Vec<String> {
                values.iter().map(|value| if value.is_finite() { finite(*value) } else { other.to_owned() }).collect()
            };
            rows.push(either(&|value| significant(value, 4), "none"));
            plain.push(either(&|value| format!("{value:?}"), ""));
        }
        page += &format!("\nLimits on the wobble at {} %, with chi and torque_share held fixed\n", 100.0 * CONFIDENCE);
        page += &readable(&rows);
        tables = plain;
    }
    write_csv(&args.output, &tables)?;
    print(&(page + &assumptions(model, &unknowns, &data)))
}

/// Refuses periods of a few pulses, and notes those for which the data are too sparse.
fn check_periods(periods: Periods, model: &TimingModel, data: &TimingData) -> Result<(), Failure> {
    let shortest = periods.first.min(periods.last);
    let least = 1000.0 / model.value(TimingParameter::F0) / DAY;
    if shortest < least {
        return Err(Failure::BadInput(format!(
            "--periods: {shortest:e} d: must be at least a thousand pulses, {least:.3e} d"
        )));
    }
    let apart = days_apart(data.arrivals.iter().map(|arrival| arrival.time[0]));
    if shortest < 2.0 * apart {
        note(&format!(
            "data are {apart:.3e} d apart, more than half of the shortest period: a wobble of that period is aliased"
        ));
    }
    Ok(())
}

fn read(args: &LimitsArgs, pulsar: &PulsarScene, start: &TimingModel) -> Result<TimingData, Failure> {
    let noise = match &args.observe {
        None => Vec::new(),
        Some(text) => parse_noise(text, &[Observable::Arrivals, Observable::Widths], 1.0)
            .map_err(|why| Failure::BadInput(format!("--observe: {why}")))?,
    };
    let data = read_timing(&args.data, &pulsar.epoch, &noise, Some(start)).map_err(Failure::BadInput)?;
    for (observable, none) in
        [(Observable::Arrivals, data.arrivals.is_empty()), (Observable::Widths, data.widths.is_empty())]
    {
        if none && noise.iter().any(|(kind, _)| *kind == observable) {
            let (key, files) = (observable.key(), args.data.join(", "));
            return Err(Failure::BadInput(format!("--observe {key}: there is no such datum in {files}")));
        }
    }
    if data.arrivals.is_empty() && data.widths.is_empty() {
        return Err(Failure::BadInput(format!("{}: no data", args.data.join(", "))));
    }
    Ok(TimingData { priors: args.prior.clone(), ..data })
}

fn tell_fit(found: &Fit<TimingModel>, data: &TimingData, pulsar: &PulsarScene) {
    note(&format!(
        "{}, {}, {}, {}; chi^2 = {} of {} of freedom",
        counted(data.arrivals.len(), "arrival"),
        counted(data.widths.len(), "width"),
        counted(data.priors.len(), "prior"),
        counted(found.iterations, "step"),
        significant(found.chi_squared, 4),
        counted(found.degrees, "degree")
    ));
    note(&format!("f0 = {} Hz at MJD {}", decimal(found.fisher.parameters.frequency()), pulsar.epoch));
    let size = significant(found.root_mean_square(), 2);
    match found.consistency() {
        Residuals::Consistent => {}
        Residuals::Larger => note(&format!(
            "the residuals are {size} times the errors stated (root mean square): the model is incomplete, or the errors are larger than stated. No limit is printed, since it would hold only for the errors stated"
        )),
        Residuals::Smaller => note(&format!("the residuals are {size} times the errors stated (root mean square)")),
    }
    note_nonlinearity(timing_nonlinearity(&found.fisher, data));
}

/// The limit on the size of s from the rate at which the line of sight approaches `L`, Eq. (41) with `I^zz / C = 4 / Omega^2` and
/// `Delta cos lambda / Delta t = -sin(lambda) lambda'`.
fn limit_on_s(found: &Fit<TimingModel>) -> Result<String, Failure> {
    let model = &found.fisher.parameters;
    let of = |parameter: TimingParameter| model.value(parameter);
    let rate = of(TimingParameter::InclinationRate);
    let sigma = found.fisher.sigma(TimingParameter::InclinationRate).unwrap_or(f64::NAN);
    let inclination = of(TimingParameter::Inclination);
    let per_rate = 4.0 * inclination.sin() / (TAU * of(TimingParameter::F0));
    let limit = limit_over_directions(inclination, per_rate * rate, per_rate * sigma)?;
    let w = Vector3::new(0.0, 0.0, SPEED * KILOMETRE);
    let alpha_2 = preferred_frame_bound(limit, &w)?;
    Ok(format!(
        "\n|2 s^ZZ - s^XX - s^YY| is at most {limit:.3e} at {} %: from the rate of the inclination by Eq. (41), with I^zz/C = 4/Omega^2 of a fluid star and an isotropic prior \
         on the directions of the axes of s\n|alpha_2| is then at most {alpha_2:.3e}, for a star that moves at {SPEED} km/s relative to the preferred frame, as the Sun does relative to the cosmic microwave background\n",
        100.0 * CONFIDENCE
    ))
}

/// Fixed parameters and assumptions of the model.
fn assumptions(model: &TimingModel, unknowns: &[TimingParameter], data: &TimingData) -> String {
    let fixed = TimingParameter::ALL.iter().filter(|parameter| !unknowns.contains(parameter));
    let stated = |parameter: TimingParameter, value: String| {
        let unit = if parameter.unit() == "1" { "" } else { parameter.unit() };
        format!("{} = {value} {unit}", parameter.key()).trim_end().to_owned()
    };
    let fixed: Vec<_> = fixed.map(|parameter| stated(*parameter, significant(model.value(*parameter), 8))).collect();
    let mut text = format!("\nHeld fixed: {}\n", fixed.join(", "));
    for Prior { parameter, mean, sigma } in &data.priors {
        text += &format!("Prior: {}\n", stated(*parameter, format!("{mean:?} +- {sigma:?}")));
    }
    text + "The model: free precession of a biaxial star, a braking torque along L, independent normal errors\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_are_in_equal_ratios() {
        let cases: [(&str, &[f64]); 5] = [
            ("50:90:2", &[50.0, 90.0]),
            ("80:20:3", &[80.0, 40.0, 20.0]),
            ("7:9:1", &[7.0]),
            ("1e-6:1e-6:1", &[1e-6]),
            ("1e9:1e9:1", &[1e9]),
        ];
        for (text, expected) in cases {
            let rates = periods(text).expect(text).rates();
            assert_eq!(rates.len(), expected.len(), "{text}");
            for (rate, days) in rates.iter().zip(expected) {
                assert!((TAU / rate / 86_400.0 / days - 1.0).abs() < 1e-14, "{text}: {rate}");
            }
        }
        assert_eq!(periods("1:2:10000").expect("as many as are allowed").rates().len(), 10_000);
        for text in ["50:90", "50:90:0", "50:90:10001", "50:90:2:2", "0.9e-6:90:2", "50:1.1e9:2", "50:NaN:2", "50:50:2"]
        {
            assert!(periods(text).is_err_and(|why| why.starts_with("must be two periods")), "{text}");
        }
    }

    #[test]
    fn a_prior_has_a_mean_and_an_error() {
        let Prior { parameter, mean, sigma } = prior("chi:-1.5:1e-100").expect("a prior");
        assert_eq!((parameter, mean, sigma), (TimingParameter::Chi, -1.5, 1e-100));
        for text in ["chi:1.5", "chi:1.5:9.9e-101", "chi:inf:1", "chi:1:inf", "chi:1:2:3"] {
            assert!(prior(text).is_err(), "{text}");
        }
    }
}
