//! Reading a table of pulsars.

use super::{Eta, Inertia, Pulsar, Quantity, SpinForm, Spread};
use crate::scene_file::{Entry, Fault, Section};

pub(super) fn read(document: &Section<'_>) -> Result<Vec<Pulsar>, Fault> {
    document.only("about pulsar")?;
    document.optional_string("about")?;
    document.repeated_section("pulsar", "a pulse of a pulsar")?.iter().map(pulsar).collect()
}

fn pulsar(section: &Section<'_>) -> Result<Pulsar, Fault> {
    section.only("name source spin_period spin_frequency width width_change lambda zeta chi years inertia_over_c density oblateness beta_0 eta w")?;
    section.not_both(&[
        ("spin_period", "spin_frequency"),
        ("lambda", "zeta"),
        ("inertia_over_c", "density"),
        ("inertia_over_c", "oblateness"),
        ("beta_0", "eta"),
    ])?;
    let name = section.required("name", "what to call it")?;
    if name.string()?.trim().is_empty() {
        return Err(name.refuse("a string that is not empty"));
    }
    let (spin_form, spin) = match section.optional("spin_frequency") {
        Some(entry) => (SpinForm::Frequency, quantity(&entry, "from 1e-5 to 1e5 [Hz]", |f| (1e-5..=1e5).contains(&f))?),
        None => {
            let entry = section.required("spin_period", "in s; or `spin_frequency` in Hz")?;
            (SpinForm::Period, quantity(&entry, "from 1e-5 to 1e5 [s]", |p| (1e-5..=1e5).contains(&p))?)
        }
    };
    let pulsar = Pulsar {
        name: name.string()?.to_owned(),
        source: section.optional_string("source")?.map(str::to_owned),
        spin_form,
        spin,
        width: quantity(&section.required("width", "W [deg]")?, "above 0 and below 360 [deg]", |w| {
            w > 0.0 && w < 360.0
        })?,
        width_change: width_change(&section.required(
            "width_change",
            "Delta W [deg]: a list of the change measured and its standard uncertainty, or one number, a limit",
        )?)?,
        lambda: lambda(section)?,
        chi: angle(&section.required("chi", "angle between spin axis and beam [deg]")?)?,
        years: quantity(&section.required("years", "Delta t")?, "from 1e-6 to 1000", |t| (1e-6..=1e3).contains(&t))?,
        inertia: inertia(section)?,
        eta: eta(section)?,
        speed: section
            .optional("w")
            .map(|w| quantity(&w, "above 0 and below 299792 [km/s]", |w| w > 0.0 && w < 299_792.0))
            .transpose()?,
    };
    // If the width is stationary or the axis points at the observer there is no bound; it is better to report this here,
    // with the place in the file.
    let refused = |error| section.fault(format!("{}: {error}", pulsar.name));
    pulsar.figures().map_err(refused)?;
    pulsar.directions().map_err(refused)?;
    Ok(pulsar)
}

fn width_change(entry: &Entry<'_>) -> Result<Quantity, Fault> {
    const MOST: f64 = 10.0;
    let change = quantity_within(entry, "from -10 to 10 [deg]", |change| change.abs() <= MOST, |_| MOST)?;
    if change.value == 0.0 && (change.spread == Spread::Rounded || change.uncertainty == 0.0) {
        return Err(entry.refuse("a number other than zero, or 0 with an uncertainty above zero; zero is not a limit"));
    }
    Ok(change)
}

fn lambda(section: &Section<'_>) -> Result<Quantity, Fault> {
    if let Some(zeta) = section.optional("zeta") {
        let zeta = angle(&zeta)?;
        return Ok(Quantity { value: 180.0 - zeta.value, ..zeta });
    }
    angle(&section.required("lambda", "from the spin axis to the direction of sight [deg]; or `zeta` = 180 - lambda")?)
}

fn inertia(section: &Section<'_>) -> Result<Inertia<Quantity>, Fault> {
    if let Some(given) = section.optional("inertia_over_c") {
        return Ok(Inertia::Given(quantity(&given, "above 0 and at most 1e20 [s^2]", |x| x > 0.0 && x <= 1e20)?));
    }
    if !section.has("density") && !section.has("oblateness") {
        return Ok(Inertia::Fluid);
    }
    Ok(Inertia::Uniform {
        density: quantity(
            &section.required("density", "in g/cm^3, with `oblateness`")?,
            "from 1e-6 to 1e17 [g/cm^3]",
            |x| (1e-6..=1e17).contains(&x),
        )?,
        oblateness: quantity(
            &section.required("oblateness", "(I^zz - I^xx) / I^xx, with `density`")?,
            "from 1e-15 to 0.99",
            |x| (1e-15..=0.99).contains(&x),
        )?,
    })
}

fn eta(section: &Section<'_>) -> Result<Eta<Quantity>, Fault> {
    if let Some(eta) = section.optional("eta") {
        return Ok(Eta::Given(quantity(&eta, "above 0 and at most 1e6", |x| x > 0.0 && x <= 1e6)?));
    }
    let Some(beta_0) = section.optional("beta_0") else { return Ok(Eta::Unknown) };
    let allowed = "above 0 and below 180 [deg], 0.001 or more from 0, 90 and 180; an axis at rest gives no bound";
    let moves = |b: f64| [0.0, 90.0, 180.0].iter().all(|rest| (b - rest).abs() >= 1e-3) && b > 0.0 && b < 180.0;
    Ok(Eta::Inclination(quantity(&beta_0, allowed, moves)?))
}

fn angle(entry: &Entry<'_>) -> Result<Quantity, Fault> {
    quantity(entry, "above 0 and below 180 [deg]", |angle| angle > 0.0 && angle < 180.0)
}

/// A number, uncertain by the rounding of its last digit, or a list of a number and its standard uncertainty.
fn quantity(entry: &Entry<'_>, allowed: &str, holds: impl Fn(f64) -> bool) -> Result<Quantity, Fault> {
    quantity_within(entry, allowed, holds, f64::abs)
}

/// As `quantity`, with the largest standard uncertainty that is allowed for a number.
fn quantity_within(
    entry: &Entry<'_>,
    allowed: &str,
    holds: impl Fn(f64) -> bool,
    largest: impl Fn(f64) -> f64,
) -> Result<Quantity, Fault> {
    if !entry.is_list() {
        let value = entry.number_where(&format!("a number {allowed}"), holds)?;
        return Ok(Quantity { value, uncertainty: entry.rounding() / 3f64.sqrt(), spread: Spread::Rounded });
    }
    let both = format!("a number {allowed}, or a list of it and its standard uncertainty");
    let entries = entry.list(&both)?;
    let [value, uncertainty] = entries.as_slice() else { return Err(entry.refuse(&both)) };
    let value = value.number_where(&format!("a number {allowed}"), holds)?;
    let largest = largest(value);
    let allowed = format!("a standard uncertainty, not negative and at most {largest}");
    let uncertainty = uncertainty.number_where(&allowed, |u| (0.0..=largest).contains(&u))?;
    Ok(Quantity { value, uncertainty, spread: Spread::Given })
}

#[cfg(test)]
mod tests {
    use crate::pulsar_table::{Inertia, pulsars};

    /// A pulse with some of its lines replaced.
    fn pulse(lines: &[&str]) -> String {
        let key = |line: &str| line.split(" =").next().unwrap_or("").to_owned();
        let usual =
            ["spin_period = 4e-3", "lambda = 95", "chi = 51", "width = 13", "width_change = 0.02", "years = 15"];
        let kept = usual.iter().filter(|usual| !lines.iter().any(|line| key(line) == key(usual)));
        let kept = kept
            .filter(|usual| !(key(usual) == "spin_period" && lines.iter().any(|line| key(line) == "spin_frequency")));
        format!("[[pulsar]]\nname = \"x\"\n{}\n{}\n", kept.copied().collect::<Vec<_>>().join("\n"), lines.join("\n"))
    }

    /// For each range, a number at or near its end, and one beyond.
    #[test]
    fn numbers_are_taken_up_to_the_ends_of_their_ranges() {
        let (density, oblateness) = ("density = 1e15", "oblateness = 1e-3");
        for (lines, taken, refused) in [
            (vec!["spin_frequency = "], &["1e-5", "1e5"][..], &["9e-6", "2e5"][..]),
            (vec!["spin_period = "], &["1e-5", "1e5"], &["9e-6", "2e5"]),
            (vec!["width = "], &["0.5"], &["0.0", "360.0"]),
            (vec!["width_change = "], &["-10.0", "10.0", "[0.0, 10.0]"], &["10.5", "[0.0, 10.5]", "0.0"]),
            (vec!["years = "], &["1e-6", "1000.0"], &["9e-7", "1001.0"]),
            (vec!["w = "], &["0.5", "299791.0"], &["0.0", "299792.0"]),
            (vec![oblateness, "density = "], &["1e-6", "1e17"], &["9e-7", "2e17"]),
            (vec![density, "oblateness = "], &["1e-15", "0.99"], &["9e-16", "1.0"]),
            (vec!["inertia_over_c = "], &["1e-30", "1e20"], &["0.0", "2e20"]),
            (vec!["eta = "], &["0.5", "1e6"], &["0.0", "2e6"]),
            (
                vec!["beta_0 = "],
                &["0.001", "0.5", "179.5", "179.999"],
                &["0.0005", "0.0", "-1.0", "89.9995", "90.0", "179.9995", "180.5"],
            ),
        ] {
            let (last, others) = lines.split_last().unwrap();
            let read = |number: &str| pulsars("table", &pulse(&[others, &[&format!("{last}{number}")]].concat()));
            for number in taken {
                assert!(read(number).is_ok(), "{last}{number}: {}", read(number).unwrap_err());
            }
            for number in refused {
                let why = read(number).expect_err(last).to_string();
                assert!(why.contains("must be"), "{last}{number}: {why}");
            }
        }
    }

    #[test]
    fn density_and_oblateness_are_what_they_are_called() {
        let pulsar = pulsars("table", &pulse(&["density = 2e14", "oblateness = 3e-4"])).unwrap().remove(0);
        let Inertia::Uniform { density, oblateness } = pulsar.inertia else { panic!("{:?}", pulsar.inertia) };
        assert_eq!((density.value, oblateness.value), (2e14, 3e-4));
    }
}
