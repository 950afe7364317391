//! `twofold fit`.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::measurement::{Measurement, note_nonlinearity, readable, uncertainties, write_csv};
use super::{Failure, FitArgs, note, print};
use twofold::inference::{Datum, Fisher, InferenceError, Place, Residuals, Signal, data_of, fit, nonlinearity};
use twofold_scene::measurements::{DataFile, beside, with_noise};
use twofold_scene::significant::significant;

pub(super) fn run(args: &FitArgs) -> Result<(), Failure> {
    let measurement = Measurement::read(&args.measurement)?;
    let refused = |error: InferenceError| measurement.refused(error);
    let Measurement { parameters, unknowns, end, .. } = &measurement;
    let mut data = if args.data.is_empty() {
        if args.simulate.is_none() {
            return Err(Failure::BadInput(format!(
                "{}: no data: allowed are files of data, or --simulate SEED, or both",
                measurement.name
            )));
        }
        simulated(&measurement)?
    } else {
        read(&measurement, &args.data)?
    };
    let mut start = *parameters;
    if let Some(seed) = args.simulate {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        data = with_noise(&data, &mut random);
        if args.data.is_empty() {
            let signal = Signal::new(parameters, *end).map_err(|error| refused(error.into()))?;
            let events = measurement.events(&signal)?;
            let fisher = Fisher::of(parameters, &events, &data, unknowns).and_then(Fisher::determined);
            start = beside(&fisher.map_err(refused)?, 3.0, &mut random)?;
            note("simulated: the fit begins three standard deviations beside the scene");
        }
    }
    let found = fit(&start, &data, unknowns, *end).map_err(refused)?;
    let [short, all] = uncertainties(&found.fisher, |unknown| measurement.unit(unknown));
    write_csv(&args.output, &all)?;
    note(&format!(
        "{} data, {} unknowns, {} steps; chi^2 = {} of {} degrees of freedom",
        data.len(),
        unknowns.len(),
        found.iterations,
        significant(found.chi_squared, 4),
        found.degrees
    ));
    let size = significant(found.root_mean_square(), 2);
    match found.judged() {
        Residuals::AsStated => {}
        Residuals::Larger => note(&format!(
            "the residuals are {size} times the errors of --observe (root mean square): the scene is no model of the data, or their errors \
             are larger; the error bars are for the errors stated"
        )),
        Residuals::Smaller => note(&format!(
            "the residuals are {size} times the errors of --observe (root mean square): the scene fits the data better than such errors allow, \
             as it does data without errors; the error bars are for the errors stated"
        )),
    }
    note_nonlinearity(nonlinearity(&found.fisher, &data, *end));
    print(&readable(&short))
}

/// The data of the scene itself, without errors. A pulse in the first turn may be cut in a model beside the scene.
fn simulated(measurement: &Measurement) -> Result<Vec<Datum>, Failure> {
    let refused = |error: twofold::Error| measurement.refused(error.into());
    let signal = Signal::new(&measurement.parameters, measurement.end).map_err(refused)?;
    let mut events = measurement.events(&signal)?;
    events.retain(|event| event.epoch + event.start > signal.turn());
    data_of(&signal, &events, &measurement.samples()?, &measurement.noise).map_err(refused)
}

/// Whether two data are one: of the same kind, number and time, to the last digit.
fn same(a: &Datum, b: &Datum) -> bool {
    a.observable == b.observable && a.value == b.value && a.place == b.place
}

/// The data in files that lie within the span of the scene.
fn read(measurement: &Measurement, files: &[String]) -> Result<Vec<Datum>, Failure> {
    let mut data = Vec::new();
    let signal =
        Signal::new(&measurement.parameters, measurement.end).map_err(|error| measurement.refused(error.into()))?;
    for file in files {
        let table = DataFile::read(file).map_err(Failure::BadInput)?;
        let of_pulses = table.is_of_pulses().map_err(Failure::BadInput)?;
        if of_pulses && signal.is_long() {
            return Err(Failure::BadInput(format!(
                "{file}: arrival times of one double each, for a span of more than 1e5 rad of rotation: allowed are --simulate and strains"
            )));
        }
        let read = if of_pulses { DataFile::pulses } else { DataFile::strain };
        let more = read(&table, &measurement.scene, &measurement.noise).map_err(Failure::BadInput)?;
        let first = more.first().copied();
        if let Some(again) = first.filter(|datum| data.iter().any(|other| same(other, datum))) {
            return Err(Failure::BadInput(format!(
                "{file}: {} = {:?} is in a file before it: allowed are data measured once",
                again.observable.key(),
                again.value
            )));
        }
        data.extend(more);
    }
    for (observable, _) in &measurement.noise {
        if data.iter().all(|datum| datum.observable != *observable) {
            return Err(Failure::BadInput(format!(
                "--observe {}: there is no such datum in {}: allowed are tables of `twofold pulses` and of `twofold run --columns h`",
                observable.key(),
                files.join(", ")
            )));
        }
    }
    for datum in &data {
        let (Place::Time(time) | Place::Turn { near: time, .. }) = datum.place;
        if !(0.0..=measurement.end).contains(&time) {
            return Err(Failure::BadInput(format!(
                "{}: a datum at t = {time:?} t_c after the start: allowed is the span of the scene {}, 0 to {:?} t_c",
                files.join(", "),
                measurement.name,
                measurement.end
            )));
        }
    }
    // A pulse in the first turn may be cut in a model beside that of the data.
    let before = data.len();
    data.retain(|datum| !matches!(datum.place, Place::Turn { near, .. } if near < signal.turn()));
    if data.len() < before {
        note(&format!(
            "{} data of the first turn are left out: their pulse may be cut in another model",
            before - data.len()
        ));
    }
    Ok(data)
}
