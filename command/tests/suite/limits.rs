//! The command `twofold limits` as a user sees it: values, limits, refusals.

use std::f64::consts::TAU;

use crate::common::{Folder, altered, ends, has_all, is_refused, number_after, stderr, stdout};

/// A folder with the files of a pulsar.
fn timed(pulsar: &str) -> Folder {
    let folder = Folder::new();
    folder.succeeds(&["timing", pulsar, "--epochs", "400", "--out", "."]);
    folder
}

/// The fields of the row with this name in a table of the command.
fn row<'t>(page: &'t str, name: &str) -> Vec<&'t str> {
    let line = page.lines().find(|line| line.split_whitespace().next() == Some(name));
    line.unwrap_or_else(|| panic!("{name} in {page}")).split_whitespace().collect()
}

#[test]
fn arrival_times_of_a_wobbling_star_give_it_back() {
    let folder = timed("b1828-11");
    let unknowns = "phase,f0,f1,f2,wobble,precession_phase,precession_rate";
    let found = folder.succeeds(&["limits", "b1828-11", "b1828-11.tim", "--parameters", unknowns]);
    let page = stdout(&found);
    // The scene states 3 degrees and 500 days.
    for (name, expected) in [("wobble", 3.0_f64.to_radians()), ("precession_rate", TAU / (500.0 * 86_400.0))] {
        let fields = row(&page, name);
        let [value, sigma] = [1, 2].map(|k| fields[k].parse::<f64>().expect("a number"));
        assert!((value - expected).abs() < 1e-2 * sigma + 1e-9 * expected, "{name}: {value} for {expected}");
    }
    assert!(page.contains("Held fixed: chi = ") && page.contains("torque_share = 1"), "{page}");
    // F0 and its epoch agree with the scene, within the error of the fit and the digits of a double-double number.
    let notes = stderr(&found);
    assert!(notes.contains("400 arrivals, 0 widths, 0 priors"), "{notes}");
    assert!(notes.contains("f0 = 2.46887171") && notes.contains(" Hz at MJD 49621.0"), "{notes}");
    // A prior is one more datum; one this sharp decides.
    let prior = ["limits", "b1828-11", "b1828-11.tim", "--parameters", unknowns, "--prior", "wobble:0.0523:1e-9"];
    let with_prior = stdout(&folder.succeeds(&prior));
    assert!((row(&with_prior, "wobble")[1].parse::<f64>().expect("a number") - 0.0523).abs() < 1e-8, "{with_prior}");
    assert!(with_prior.contains("Prior: wobble = 0.0523 +- 1e-9 rad\n"), "{with_prior}");
    assert!(!page.contains("Prior"), "{page}");
}

/// Comments, times without numbers, and a table of the same times.
#[test]
fn the_same_times_in_other_files_are_the_same_data() {
    let folder = timed("b1937+21");
    let tim = folder.read("b1937+21.tim");
    let lines = tim.lines().skip(1).map(|line| line.split(" -pn").next().expect("a line").replace('@', "BAT"));
    let bare: Vec<_> =
        ["# a comment".to_owned(), "C another".to_owned(), "FORMAT 1".to_owned()].into_iter().chain(lines).collect();
    folder.write("bare.tim", bare.join("\n"));
    let page = |args: &[&str]| {
        let all: Vec<_> = ["limits", "b1937+21"].iter().chain(args).copied().collect();
        stdout(&folder.succeeds(&all))
    };
    let expected = page(&["b1937+21.tim"]);
    assert_eq!(page(&["bare.tim"]), expected);
    let fields = |page: &str| row(page, "f1")[2].to_owned();
    assert_eq!(fields(&page(&["b1937+21.csv", "--observe", "arrivals:1e-6"])), fields(&expected));
}

/// From `N` times with the error `sigma` an amplitude has the error `sigma (2 / N)^(1/2)`; the amplitude of a small wobble is
/// `theta cot chi / (2 pi F0)`, and half a normal distribution has its 95 % quantile at 1.96.
#[test]
fn the_limit_on_a_wobble_is_that_of_an_amplitude() {
    let folder = timed("b1937+21");
    let args = ["limits", "b1937+21", "b1937+21.tim", "--periods", "20:200:3", "--out", "limits.csv"];
    let found = folder.succeeds(&args);
    let page = stdout(&found);
    assert!(page.contains("Limits on the wobble at 95 %"), "{page}");
    // There is no statement about s if the inclination is held fixed.
    assert!(!page.contains("s^ZZ") && page.contains(" 20.00 ") && page.contains("chi = 1.3089969 rad, "), "{page}");
    assert!(page.ends_with("a braking torque along L, independent normal errors\n"), "{page}");
    let table = folder.read("limits.csv");
    let shown = page.lines().skip_while(|line| !line.contains("limit of the wobble")).skip(2);
    let shown: Vec<Vec<f64>> = shown
        .map_while(|line| line.split_whitespace().map(|word| word.parse().ok()).collect::<Option<Vec<_>>>())
        .take_while(|row| !row.is_empty())
        .collect();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|x| x.parse().expect("a number")).collect()).collect();
    assert_eq!((rows.len(), shown.len()), (3, 3), "{table}{page}");
    // The page has four digits.
    for (shown, exact) in shown.iter().flatten().zip(rows.iter().flatten()) {
        assert!((shown - exact).abs() <= 5e-4 * exact.abs(), "{shown} {exact}");
    }
    let chi = 75.0_f64.to_radians();
    let expected = 1.96 * 1e-6 * (2.0_f64 / 400.0).sqrt() * TAU * 641.928 * chi.tan();
    for (row, period) in rows.iter().zip([20.0, 63.245_553, 200.0]) {
        assert!((row[0] / period - 1.0).abs() < 1e-6, "{table}");
        assert!((row[3] / expected - 1.0).abs() < 0.05, "{} for {expected}", row[3]);
    }
    // 400 times in 15 years are 13.7 d apart: less than 20 d, but more than half of it.
    let told = stderr(&found);
    assert!((number_after(&told, "data are ") / (5478.75 / 399.0) - 1.0).abs() < 1e-3, "{told}");
    let rarer = folder.succeeds(&["limits", "b1937+21", "b1937+21.tim", "--periods", "200:40:2"]);
    assert!(!stderr(&rarer).contains("data are "), "{}", stderr(&rarer));
}

/// Over a span `T` the slope of `N` widths has the error `sigma (12 / N)^(1/2) / T`.
#[test]
fn widths_limit_the_motion_of_the_axis_and_s() {
    // Without Lorentz violation the inclination, and with it the width, is constant.
    let folder = Folder::with(&[("star.toml", &altered("b1937+21", &[("alpha_2 = 1.6e-9", "alpha_2 = 0.0")]))]);
    folder.succeeds(&["timing", "star.toml", "--epochs", "400", "--out", "."]);
    let args = ["limits", "star.toml", "star.csv", "--observe", "widths:1e-6"];
    let page = stdout(&folder.succeeds(&args));
    let again = folder.run(&["limits", "star.toml", "star.csv", "star.csv", "--observe", "widths:1e-6"]);
    is_refused(&again, &["star.csv: the datum of MJD ", "also in an earlier file"]);
    // Split into two files, the data are the same.
    let table = folder.read("star.csv");
    let lines: Vec<_> = table.lines().collect();
    folder.write("first.csv", lines[..200].join("\n"));
    folder.write("rest.csv", [&lines[..1], &lines[200..]].concat().join("\n"));
    let halves = ["limits", "star.toml", "first.csv", "rest.csv", "--observe", "widths:1e-6"];
    let halves = stdout(&folder.succeeds(&halves));
    assert_eq!(row(&halves, "inclination_rate")[2], row(&page, "inclination_rate")[2]);
    let sigma: f64 = row(&page, "inclination_rate")[2].parse().expect("a number");
    let times: Vec<f64> = folder
        .read("star.csv")
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(1).and_then(|day| day.parse().ok()).expect("a day"))
        .collect();
    let span = (times[times.len() - 1] - times[0]) * 86_400.0;
    // cos rho = cos Theta cos i + sin Theta sin i cos(W / 2), with the angles of the scene, gives dW/di at a fixed rho.
    let (theta, i, rho) =
        (75.0_f64.to_radians(), 80.0_f64.to_radians(), row(&page, "rho")[1].parse::<f64>().expect("rho"));
    let half = ((rho.cos() - theta.cos() * i.cos()) / (theta.sin() * i.sin())).acos();
    let slope =
        2.0 * (theta.sin() * i.cos() * half.cos() - theta.cos() * i.sin()) / (theta.sin() * i.sin() * half.sin());
    let expected = 1e-6 * (12.0_f64 / 400.0).sqrt() / span * TAU * 641.928 / slope.abs();
    assert!((sigma / expected - 1.0).abs() < 0.02, "{sigma} for {expected}");
    // The product of a normal number of mean zero and eta for unknown directions has its 95 % quantile at 103.08 deviations if the spin axis is at 40
    // deg to the line of sight, by the quadratures of another program, and in inverse proportion to the sine of that angle.
    let limit = number_after(&page, "|2 s^ZZ - s^XX - s^YY| is at most ");
    let expected = 103.08 * 40.0_f64.to_radians().sin() / i.sin() * 4.0 * i.sin() * sigma / (TAU * 641.928);
    // The page has three digits of the deviation.
    assert!((limit / expected - 1.0).abs() < 5e-3, "{limit} for {expected}");
    // s = -alpha_2 w w, so that the combination is 2 alpha_2 |w|^2; both numbers have four digits.
    let alpha_2 = number_after(&page, "|alpha_2| is then at most ");
    assert!((alpha_2 * 2.0 * (369.0_f64 / 299_792.458).powi(2) / limit - 1.0).abs() < 1e-3, "{alpha_2}");
    // With errors far below the rounding of the table the residuals are larger than stated, and there is no limit.
    let off = |(k, line): (usize, &str)| {
        let mut fields: Vec<_> = line.split(',').map(str::to_owned).collect();
        let place = lines[0].split(',').position(|name| name.starts_with("duration")).expect("durations");
        if k > 0 {
            let width: f64 = fields[place].parse().expect("a number");
            fields[place] = (width * if k % 2 == 0 { 1.1 } else { 0.9 }).to_string();
        }
        fields.join(",")
    };
    folder.write("scattered.csv", table.lines().enumerate().map(off).collect::<Vec<_>>().join("\n"));
    let page = stdout(&folder.succeeds(&["limits", "star.toml", "scattered.csv", "--observe", "widths:1e-6"]));
    assert!(!page.contains("s^ZZ") && row(&page, "inclination_rate").len() > 2, "{page}");
}

#[test]
fn what_is_wrong_is_named() {
    let folder = timed("b1937+21");
    let line = |text: &str| format!("FORMAT 1\n{text}\n");
    for (name, text) in [
        ("site.tim", line("a 0.0 55321.5 1.0 ao")),
        ("frequency.tim", line("a 1400 55321.5 1.0 @")),
        ("error.tim", line("a 0.0 55321.5 -1.0 @")),
        ("date.tim", line("a 0.0 5532l.5 1.0 @")),
        ("number.tim", line("a 0.0 55321.5 1.0 @ -pn x")),
        ("fields.tim", line("a 0.0 55321.5")),
        ("old.tim", "FORMAT 2\n".to_owned()),
        ("flag.tim", line("a 0.0 55321.5 1.0 @ -padd 0.3")),
        ("no.csv", "x,y\n1,2\n".to_owned()),
        ("empty.tim", "FORMAT 1\n".to_owned()),
        ("twice.tim", line("a 0.0 55321.5 1.0 @\nb 0.0 55322.5 1.0 @\nc 0.0 55322.5 2.0 @")),
        ("half.tim", line("a 0.0 55321.5 1.0 @\nb 0.0 55322.5 1.0 @")),
        ("rest.tim", line("a 0.0 55320.5 1.0 @\nb 0.0 55321.5 1.0 @")),
    ] {
        std::fs::write(folder.at(name), text).expect("a file");
    }
    let refusals: [(&[&str], &[&str]); 26] = [
        (&["site.tim"], &["site.tim:2: site `ao`", "must be one of @"]),
        (&["frequency.tim"], &["frequency.tim:2: frequency `1400`", "must be 0"]),
        (&["error.tim"], &["error.tim:2: uncertainty `-1.0`", "from 1e-9 to 1e12"]),
        (&["date.tim"], &["date.tim:2: `5532l.5`", "decimal number"]),
        (&["number.tim"], &["number.tim:2: `-pn` = `x`", "whole number"]),
        (&["fields.tim"], &["fields.tim:2: `a 0.0 55321.5`", "expected a name"]),
        (&["old.tim"], &["old.tim:1: `FORMAT 2`", "FORMAT 1"]),
        (&["no.csv", "--observe", "arrivals:1e-6"], &["no.csv: missing column `arrival_day [MJD]`"]),
        (&["b1937+21.csv"], &["a table has no standard deviations", "--observe"]),
        (&["b1937+21.csv", "--observe", "periods:1"], &["--observe: `periods`", "arrivals, widths"]),
        (&["b1937+21.tim", "--parameters", "fO"], &["--parameters: `fO` is not a parameter", "f0"]),
        (&["b1937+21.tim", "--prior", "chi:1.2:0.1"], &["--prior chi", "chi is not in --parameters"]),
        (&["b1937+21.tim", "--prior", "chi:1.2:0"], &["chi:1.2:0", "at least 1e-100"]),
        (&["b1937+21.tim", "--prior", "all:1.2:0.1"], &["all:1.2:0.1", "must be a parameter"]),
        (&["flag.tim"], &["flag.tim:2: `-padd` changes the time"]),
        (&["empty.tim"], &["empty.tim: no data"]),
        (&["b1937+21.tim", "b1937+21.tim"], &["b1937+21.tim: the datum of MJD ", "given only once"]),
        (&["twice.tim"], &["twice.tim: the datum of MJD 55322.5 occurs twice", "given only once"]),
        (&["half.tim", "rest.tim"], &["rest.tim: the datum of MJD 55321.5 ", "also in an earlier file"]),
        (&["b1937+21.tim", "--observe", "widths:1e-5"], &["--observe widths: there is no such datum"]),
        (&["b1937+21.tim", "--periods", "1:1e-5:2"], &["--periods: 1e-5 d", "at least a thousand pulses, 1.803e-5 d"]),
        (&["b1937+21.tim", "--prior", "rho:0.2:1e-320"], &["rho:0.2:1e-320", "at least 1e-100"]),
        (
            &["b1937+21.tim", "--parameters", "phase,chi", "--prior", "chi:1.3:0.2", "--periods", "50:90:2"],
            &["chi", "held fixed"],
        ),
        (&["b1937+21.tim", "--out", "b1937+21.tim", "--force"], &["--out b1937+21.tim is also an input file"]),
        (&["b1937+21.tim", "--out=b1937+21.tim", "--force"], &["--out b1937+21.tim is also an input file"]),
        (&["b1937+21.tim", "--periods", "50:20"], &["50:20", "two periods"]),
    ];
    for (args, reasons) in refusals {
        let all: Vec<&str> = ["limits", "b1937+21"].into_iter().chain(args.iter().copied()).collect();
        is_refused(&folder.run(&all), reasons);
    }
    let blind = ends(folder.run(&["limits", "b1937+21", "b1937+21.tim", "--parameters", "phase,rho"]), 1);
    has_all(&stderr(&blind), &["do not determine", "d(rho) alone"]);
    // A detected wobble gives no limit.
    let folder = timed("isolated-pulsar");
    let wobbling = folder.run(&["limits", "isolated-pulsar", "isolated-pulsar.tim", "--periods", "50:2000:5"]);
    has_all(&stderr(&wobbling), &["wobble (rad)", "zero"]);
    assert!(!wobbling.status.success());
    // Every second pulse is 86 microseconds late, which no parameter explains.
    let folder = timed("b1937+21");
    let table = folder.read("b1937+21.csv");
    let mut text = String::from("arrival_day [MJD],arrival_fraction [d]\n");
    for (k, line) in table.lines().skip(1).enumerate() {
        let fields: Vec<_> = line.split(',').collect();
        let fraction: f64 = fields[2].parse().expect("a number");
        text += &format!("{},{:?}\n", fields[1], fraction + 1e-9 * (k % 2) as f64);
    }
    folder.write("late.csv", text);
    let other = ["limits", "b1937+21", "late.csv", "--observe", "arrivals:1e-6", "--periods", "50:90:2"];
    let other = ends(folder.run(&[&other[..], &["--out", "limits.csv"]].concat()), 1);
    assert!(stderr(&other).contains("No limit is printed") && !stdout(&other).contains("limit of the wobble"));
    assert!(
        stderr(&other).contains("--periods: no limits")
            && stdout(&other).contains("f0")
            && stdout(&other).ends_with("independent normal errors\n")
            && !folder.at("limits.csv").exists()
    );
}

/// F2 of a star whose F1 is zero at the start of the fit, and F2 of timing noise; and two files with different pulse numbers.
#[test]
fn any_f2_is_fitted_and_files_count_for_themselves() {
    let folder = timed("b1937+21");
    let unknowns = "phase,f0,f1,f2";
    let args =
        ["limits", "b1937+21", "b1937+21.tim", "b1937+21.csv", "--observe", "arrivals:1e-6", "--parameters", unknowns];
    let again = folder.run(&args);
    has_all(&stderr(&again), &["given only once"]);
    let lines: Vec<_> = folder.read("b1937+21.tim").lines().map(str::to_owned).collect();
    folder.write("half.tim", lines[..200].join("\n"));
    let table: Vec<_> = folder.read("b1937+21.csv").lines().map(str::to_owned).collect();
    folder.write("rest.csv", [&table[..1], &table[250..]].concat().join("\n"));
    let args = ["limits", "b1937+21", "half.tim", "rest.csv", "--observe", "arrivals:1e-6", "--parameters", unknowns];
    let found = folder.succeeds(&args);
    assert!(number_after(&stderr(&found), "chi^2 = ") < 1e-3, "{}", stderr(&found));
}
