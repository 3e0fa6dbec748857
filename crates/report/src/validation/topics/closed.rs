//! Motions of one block or a column that have a formula.

mod bodies;

use bodies::{FRICTION, G, MASS, SPEED, SPIN};
use glam::DVec3;
use serde_json::json;
use teeter_scene::Form;
use teeter_study::{par_map, torsion};

use crate::chart::{Axis, Chart, Series};
use crate::error::Error;
use crate::statistics::{max, mean};
use crate::validation::section::Section;
use crate::validation::size::Size;

/// Edges of the blocks that spin, m: the patch on the floor is the first by the second.
const SPINNING: [[f64; 3]; 4] =
    [[0.081, 0.0268, 0.018], [0.081, 0.018, 0.0268], [0.0268, 0.018, 0.018], [0.0268, 0.0268, 0.018]];
/// Drops whose restitution is averaged: single ones depend on the phase of the substep at impact.
const DROPS: u32 = 40;

/// Restitutions of the scenes: the range that users ask for.
const RESTITUTIONS: [f64; 7] = [0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9];

/// Table of measured and expected values.
#[derive(Default)]
struct Rows(Vec<Vec<String>>);

impl Rows {
    /// Adds a row and returns the relative error.
    fn add(&mut self, what: &str, (measured, expected): (f64, f64), unit: &str) -> f64 {
        let error = measured / expected - 1.0;
        self.0.push(vec![
            what.into(),
            format!("{measured:.5} {unit}"),
            format!("{expected:.5} {unit}"),
            format!("{:+.2} %", 100.0 * error),
        ]);
        error.abs()
    }
}

/// Compares motions with their formulas.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "closed",
        "Closed forms",
        "One block or a column of ten, where mechanics has a formula. A column is pulled at each \
         of its blocks in turn by a force that grows until it slips. The grain of wood is not \
         modelled: friction is the same in all directions, which is measured here.",
    );
    let (mut rows, form) = (Rows::default(), size.form);
    let (push, pushes) = column_errors(size)?;
    let value = format!("{:.2} %", 100.0 * push);
    section.goal("column push, largest difference from Coulomb", value, "0.5 %", push <= 5e-3);
    section.number("column_push_error", push);
    let mut errors = slides(form, &mut rows)?.to_vec();
    errors.extend(breakaway_forces(form, &mut rows)?);
    let value = format!("{:.2} %", 100.0 * max(&errors));
    section.goal("slides and starts, largest difference from Coulomb", value, "1 %", max(&errors) <= 0.01);
    section.number("slide_error", max(&errors));
    incline(form, &mut section)?;
    let spins = max(&spins(form, &mut rows)?);
    let value = format!("{:.1} %", 100.0 * spins);
    section.number("spin_error", spins);
    section.inform("spins on patches of four shapes, largest difference from a uniform pressure", value);
    let restitution = restitution(form, &mut rows)?;
    let errors: Vec<f64> = restitution.iter().map(|(expected, measured)| (measured - expected).abs()).collect();
    section.goal("restitution of flat drops", format!("within {:.3}", max(&errors)), "0.05", max(&errors) <= 0.05);
    section.number("restitution_error", max(&errors));
    section.table(&["what", "measured", "expected", "off"], rows.0);
    section.data = json!({"pushes_over_coulomb": pushes, "restitution": restitution});
    section.charts.push(Chart {
        title: "Restitution of flat drops".into(),
        x: Axis::new("of the scene"),
        y: Axis::new("of the engine"),
        series: vec![Series::line("mean of 40 drops", restitution)],
        diagonal: true,
        ..Chart::default()
    });
    Ok(section)
}

/// Largest relative error of the breakaway forces of a column, and all forces over Coulomb's. A
/// block that does not move has an infinite error.
fn column_errors(size: &Size) -> Result<(f64, Vec<f64>), Error> {
    let ratios = bodies::column(size)?;
    let error = |ratio: &f64| if ratio.is_nan() { f64::INFINITY } else { (ratio - 1.0).abs() };
    Ok((max(&ratios.iter().map(error).collect::<Vec<_>>()), ratios))
}

/// Errors of the distances v² / (2 µ g) at which sliding blocks stop.
fn slides(form: Form, rows: &mut Rows) -> Result<[f64; 2], Error> {
    let expected = |friction: f64| SPEED * SPEED / (2.0 * friction * G);
    let equal = bodies::stopping_distance(form, 0.4, None)?;
    let lower = bodies::stopping_distance(form, 0.5, Some(0.3))?;
    Ok([
        rows.add("distance until a block at 0.5 m/s stops, mu 0.4", (equal, expected(0.4)), "m"),
        rows.add("the same, static 0.5 and kinetic 0.3", (lower, expected(0.3)), "m"),
    ])
}

/// Errors of the breakaway forces µ m g of a block.
fn breakaway_forces(form: Form, rows: &mut Rows) -> Result<Vec<f64>, Error> {
    let weight = MASS * G;
    let mut errors = Vec::new();
    for direction in [0.0, 30.0, 45.0, 90.0_f64] {
        let (sin, cos) = libm::sincos(direction.to_radians());
        let force = bodies::breakaway_force(form, (FRICTION, None), DVec3::new(cos, sin, 0.0))?;
        let what = format!("force that starts a block at {direction} degrees to its length");
        errors.push(rows.add(&what, (force, FRICTION * weight), "N"));
    }
    for friction in [0.25, 0.5] {
        let force = bodies::breakaway_force(form, (friction, None), DVec3::X)?;
        errors.push(rows.add(&format!("force that starts a block, mu {friction}"), (force, friction * weight), "N"));
    }
    let force = bodies::breakaway_force(form, (0.5, Some(0.35)), DVec3::X)?;
    errors.push(rows.add("force that starts a block, static 0.5 and kinetic 0.35", (force, 0.5 * weight), "N"));
    Ok(errors)
}

/// Displacements in 10 s just below and just above the angle of friction.
fn incline(form: Form, section: &mut Section) -> Result<(), Error> {
    let below = bodies::incline_displacement(form, 0.998 * FRICTION)?;
    section.number("incline_creep_m", below);
    let above = bodies::incline_displacement(form, 1.005 * FRICTION)?;
    let what = "incline at 0.998 of the angle of friction, creep in 10 s";
    section.goal(what, format!("{below:.1e} m"), "1e-8 m", below < 1e-8);
    let what = "incline at 1.005 of it, displacement in 10 s";
    section.goal(what, format!("{:.0} mm", 1e3 * above), "slides", above > 5e-3);
    Ok(())
}

/// Errors of the times ω I / (µ m g d) after which spins end, with d the mean distance from the
/// centre of the patch.
fn spins(form: Form, rows: &mut Rows) -> Result<Vec<f64>, Error> {
    let mut errors = Vec::new();
    for size in SPINNING {
        let [a, b, _] = size;
        let distance = torsion::rectangle_mean_distance(a, b);
        let inertia = MASS * (a * a + b * b) / 12.0;
        let expected = SPIN * inertia / (FRICTION * MASS * G * distance);
        let what = format!("time until a spin of 10 rad/s on a patch of {:.1} x {:.1} mm ends", 1e3 * a, 1e3 * b);
        errors.push(rows.add(&what, (bodies::spin_time(form, size)?, expected), "s"));
    }
    Ok(errors)
}

/// Mean restitution of flat drops by that of the scene.
fn restitution(form: Form, rows: &mut Rows) -> Result<Vec<(f64, f64)>, Error> {
    let mut points = Vec::new();
    for expected in RESTITUTIONS {
        let drops: Vec<u32> = (0..DROPS).collect();
        let ratios = par_map(&drops, |&i| bodies::bounce(form, expected, 0.01 + 1.37e-6 * f64::from(i)));
        let ratio = mean(&ratios.into_iter().collect::<Result<Vec<f64>, _>>()?);
        points.push((expected, ratio));
        rows.add(&format!("restitution of a flat drop, {expected}"), (ratio, expected), "");
    }
    Ok(points)
}
