//! Arrival times and widths of pulses: `.tim` files and tables of them, the timing model of their fits, and tables for Python.

use std::hint::black_box;
use std::sync::OnceLock;

use twofold::epoch::Epoch;
use twofold::inference::{
    MeasuredArrival, MeasuredWidth, Observable, Prior, TimingData, fit_timing, timing_fisher, timing_nonlinearity,
    wobble_limits,
};
use twofold::observables::pulsar::timing_model::{TimingModel, TimingParameter};
use twofold_scene::measurements::DataFile;
use twofold_scene::pulsar_timing::PulsarScene;
use twofold_scene::read_table::{Values, columns_of};
use twofold_scene::scene_file::{Scene, built_in};

use super::bytes::{Bytes, finite};

/// Largest number of fitted data, and the period of the wobble (s) whose limit is computed.
const MOST_FITTED: usize = 40;
const PERIOD: f64 = 1e7;

/// Largest change of an epoch that is written and read again (s).
const ROUNDING: f64 = 1e-10;

/// A pulsar without a wobble, and one with a wobble that slows down.
fn pulsars() -> &'static [(Epoch, TimingModel); 2] {
    static PULSARS: OnceLock<[(Epoch, TimingModel); 2]> = OnceLock::new();
    PULSARS.get_or_init(|| {
        ["b1937+21", "b1828-11"].map(|name| {
            let scene = Scene::from_toml(name, built_in(name).expect("a scene").toml).expect("a scene");
            let pulsar = PulsarScene::new(&scene).expect("a pulsar");
            (pulsar.epoch, pulsar.clock.timing_model().expect("a model"))
        })
    })
}

/// The parameters whose bits are set.
fn chosen(bits: usize) -> Vec<TimingParameter> {
    TimingParameter::ALL
        .into_iter()
        .enumerate()
        .filter(|(k, _)| bits >> k & 1 == 1)
        .map(|(_, unknown)| unknown)
        .collect()
}

/// A `.tim` or a table of arrival times and widths, after three bytes that choose pulsar, observables and unknowns: refused with its name, or finite
/// data that are unchanged after writing and reading; numbered, and fitted if they are few.
pub fn timing_file(bytes: &[u8]) {
    let Some(([kind, first, second], text)) = bytes.split_first_chunk() else { return };
    let name = if kind & 1 == 0 { "data.tim" } else { "data.csv" };
    let Ok(file) = DataFile::of_bytes(name, text.to_vec()) else { return };
    let (epoch, model) = &pulsars()[usize::from(kind >> 1 & 1)];
    let noise = [(Observable::Arrivals, 1e-6), (Observable::Widths, 1e-5), (Observable::StrainPlus, 1.0)];
    let noise: Vec<_> =
        noise.into_iter().enumerate().filter(|(k, _)| kind >> (k + 2) & 1 == 1).map(|(_, one)| one).collect();
    let mut data = TimingData::default();
    if let Err(why) = file.add_timing(epoch, &noise, &mut data) {
        return assert!(why.starts_with(name), "{why}");
    }
    for MeasuredArrival { time, sigma, .. } in &data.arrivals {
        assert!(time.iter().all(|part| part.is_finite()) && *sigma > 0.0 && sigma.is_finite());
    }
    for MeasuredWidth { time, duration, sigma } in &data.widths {
        assert!(time.is_finite() && duration.is_finite() && *duration > 0.0 && *sigma > 0.0);
    }
    is_read_again(&data, epoch);
    if data.arrivals.len() + data.widths.len() <= MOST_FITTED {
        fitted(model, &data, &chosen(usize::from(*first) << 8 | usize::from(*second)));
    }
}

/// Written arrival times are the same when read again.
fn is_read_again(data: &TimingData, epoch: &Epoch) {
    let date = |arrival: &MeasuredArrival| epoch.after(arrival.time).expect("a date that was read");
    // A date that is rounded to one before 0 cannot stand in a file.
    if data.arrivals.iter().any(|arrival| date(arrival).day() < 0) {
        return;
    }
    let line = |arrival: &MeasuredArrival| {
        let number = arrival.number.map_or(String::new(), |number| format!(" -pn {number}"));
        format!("a 0 {} {:?} @{number}\n", date(arrival), arrival.sigma * 1e6)
    };
    let text: String = ["FORMAT 1\n".to_owned()].into_iter().chain(data.arrivals.iter().map(line)).collect();
    let mut again = TimingData::default();
    let file = DataFile::of_bytes("again.tim", text.into_bytes()).expect("text");
    file.add_timing(epoch, &[], &mut again).expect("what was read is written as it may be read");
    assert_eq!(again.arrivals.len(), data.arrivals.len());
    for (one, other) in again.arrivals.iter().zip(&data.arrivals) {
        let apart = (one.time[0] - other.time[0]) + (one.time[1] - other.time[1]);
        assert!(apart.abs() <= ROUNDING && one.number == other.number, "{one:?} for {other:?}");
        assert!((one.sigma / other.sigma - 1.0).abs() < 1e-14, "{one:?} for {other:?}");
    }
}

/// The uncertainties of unknowns: finite numbers, or a reason for none.
fn fitted(model: &TimingModel, data: &TimingData, unknowns: &[TimingParameter]) {
    let _ = black_box(timing_fisher(model, data, unknowns).map(|fisher| fisher.sigmas()));
    if let Ok(found) = fit_timing(model, data, unknowns) {
        let numbers = [found.fisher.values(), found.fisher.sigmas(), found.residuals.clone(), vec![found.chi_squared]];
        assert!(numbers.iter().flatten().all(|number| number.is_finite()), "{found:?}");
        let _ = black_box((found.consistency(), timing_nonlinearity(&found.fisher, data)));
    }
    let rates = [std::f64::consts::TAU / PERIOD];
    for limit in wobble_limits(model, data, unknowns, &rates, 0.95).into_iter().flatten() {
        assert!(limit.limit >= 0.0, "{limit:?}");
    }
}

/// A timing model and data with arbitrary numbers, as from Python: a result or an error, in bounded time, and finite results for moderate numbers.
pub fn timing_model(bytes: &[u8]) {
    let mut bytes = Bytes::new(bytes);
    let frequency = [bytes.number(), bytes.usual() * 1e-17];
    let given: Vec<_> = chosen(bytes.below(1 << TimingParameter::ALL.len()))
        .into_iter()
        .map(|parameter| (parameter, bytes.usual()))
        .collect();
    // Numbers typical of a pulsar, for which the model is usually valid.
    let scaled = |(parameter, value): (TimingParameter, f64)| {
        let unit = match parameter {
            TimingParameter::F1 | TimingParameter::InclinationRate => 1e-13,
            TimingParameter::F2 => 1e-22,
            TimingParameter::PrecessionRate => 1e-6,
            TimingParameter::Damping => 1e-9,
            _ => 1.0,
        };
        (parameter, value * unit)
    };
    let is_scaled = bytes.byte() < 192;
    let given: Vec<_> = given.into_iter().map(|one| if is_scaled { scaled(one) } else { one }).collect();
    let Ok(model) = TimingModel::new(frequency, &given) else { return };
    let changes = [(TimingParameter::F0, bytes.number()), (TimingParameter::Chi, bytes.usual())];
    finite(bytes.moderate, model.moved(&changes));
    let long = |bytes: &mut Bytes<'_>| bytes.number() * 1e8;
    for _ in 0..4 {
        let time = [long(&mut bytes), bytes.usual() * 1e-9];
        finite(bytes.moderate, model.phase(time));
        finite(bytes.moderate, model.phase_and_derivatives(time));
        finite(bytes.moderate, model.width(time[0]));
        for number in [bytes.number(), bytes.usual() * 1e12] {
            finite(bytes.moderate, model.arrival(number as i64));
        }
    }
    let unknowns = chosen(bytes.below(1 << TimingParameter::ALL.len()));
    let rate = bytes.usual() * 1e-6;
    let mut data = TimingData::default();
    while !bytes.is_empty() && data.arrivals.len() + data.widths.len() < MOST_FITTED {
        let (kind, time, sigma) = (bytes.byte(), [long(&mut bytes), bytes.usual() * 1e-9], bytes.usual().abs() * 1e-3);
        match kind {
            0..64 => data.widths.push(MeasuredWidth { time: time[0], duration: bytes.usual(), sigma }),
            64..128 => data.arrivals.push(MeasuredArrival { time, sigma, number: Some(bytes.number() as i64) }),
            128..248 => data.arrivals.push(MeasuredArrival { time, sigma, number: None }),
            _ => {
                data.priors.extend(unknowns.first().map(|unknown| Prior { parameter: *unknown, mean: time[0], sigma }))
            }
        }
    }
    let _ = black_box(wobble_limits(&model, &data, &unknowns, &[rate], 0.95));
    fitted(&model, &data, &unknowns);
}

/// A table passed to Python: refused with a reason, or columns with one field per row that are finite, missing, or words.
pub fn table(bytes: &[u8]) {
    let Ok((columns, rows)) = columns_of(bytes).inspect_err(|why| assert!(!why.is_empty())) else { return };
    for column in columns {
        match column.values {
            Values::Numbers(numbers) => {
                assert_eq!(numbers.len(), rows);
                assert!(numbers.iter().all(|number| number.is_finite() || number.is_nan()));
            }
            Values::Words(words) => assert_eq!(words.len(), rows),
        }
    }
}
