//! Reading a table of pulsars.

use super::{Eta, Inertia, Pulsar, Quantity, SpinForm, Spread};
use crate::scene_file::{Entry, Fault, Section};

pub(super) fn read(document: &Section<'_>) -> Result<Vec<Pulsar>, Fault> {
    document.only(&["about", "pulsar"])?;
    document.optional("about").map(|entry| entry.string()).transpose()?;
    document.repeated_section("pulsar", "a pulse of a pulsar")?.iter().map(pulsar).collect()
}

fn pulsar(section: &Section<'_>) -> Result<Pulsar, Fault> {
    section.only(&[
        "name",
        "spin_period",
        "spin_frequency",
        "width",
        "width_change",
        "lambda",
        "zeta",
        "chi",
        "years",
        "inertia_over_c",
        "density",
        "oblateness",
        "beta_0",
        "eta",
        "w",
    ])?;
    for (first, second) in [
        ("spin_period", "spin_frequency"),
        ("lambda", "zeta"),
        ("inertia_over_c", "density"),
        ("inertia_over_c", "oblateness"),
        ("beta_0", "eta"),
    ] {
        section.not_both(first, second)?;
    }
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
        spin_form,
        spin,
        width: quantity(&section.required("width", "W [deg]")?, "above 0 and below 360 [deg]", |w| {
            w > 0.0 && w < 360.0
        })?,
        width_change: quantity(
            &section.required("width_change", "bound on Delta W [deg]")?,
            "from -10 to 10 [deg] and not zero: a bound of zero is none",
            |change| change != 0.0 && change.abs() <= 10.0,
        )?,
        lambda: lambda(section)?,
        chi: angle(&section.required("chi", "angle between spin axis and beam [deg]")?)?,
        years: quantity(&section.required("years", "Delta t")?, "above 0 and at most 1000", |t| t > 0.0 && t <= 1e3)?,
        inertia: inertia(section)?,
        eta: eta(section)?,
        speed: section
            .optional("w")
            .map(|w| quantity(&w, "above 0 and below 299792 [km/s]", |w| w > 0.0 && w < 299_792.0))
            .transpose()?,
    };
    // Where the width is stationary there is no bound: better said now, with the place.
    pulsar.figures().map_err(|error| section.fault(format!("{}: {error}", pulsar.name)))?;
    Ok(pulsar)
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
    let Some(beta_0) = section.optional("beta_0") else { return Ok(Eta::Conservative) };
    let allowed = "above 0 and below 180 [deg], and not 90: an axis at rest bounds nothing";
    Ok(Eta::Inclination(quantity(&beta_0, allowed, |b| b > 0.0 && b < 180.0 && b != 90.0)?))
}

fn angle(entry: &Entry<'_>) -> Result<Quantity, Fault> {
    quantity(entry, "above 0 and below 180 [deg]", |angle| angle > 0.0 && angle < 180.0)
}

/// A number, uncertain by the rounding of its last digit, or a list of a number and its standard uncertainty.
fn quantity(entry: &Entry<'_>, allowed: &str, holds: impl Fn(f64) -> bool) -> Result<Quantity, Fault> {
    if !entry.is_list() {
        let value = entry.number_where(&format!("a number {allowed}"), holds)?;
        return Ok(Quantity { value, uncertainty: entry.rounding() / 3f64.sqrt(), spread: Spread::Rounded });
    }
    let both = format!("a number {allowed}, or a list of it and its standard uncertainty");
    let entries = entry.list(&both)?;
    let [value, uncertainty] = entries.as_slice() else { return Err(entry.refuse(&both)) };
    Ok(Quantity {
        value: value.number_where(&format!("a number {allowed}"), holds)?,
        uncertainty: uncertainty.number_where("a standard uncertainty, not negative", |u| u >= 0.0)?,
        spread: Spread::Given,
    })
}
