//! Closed forms: what mechanics says exactly of one block or a column.

use glam::DVec3;
use serde_json::json;
use teeter_physics::{BodyId, Input, Params, Twist, World};
use teeter_scene::{Block, Form, Scene, named};
use teeter_study::{breakaway_force, par_map, settled, torsion};

use super::super::plot::{Axis, Plot, Series};
use super::super::section::{Section, Size, params};
use super::super::stats::{largest, mean};
use super::built;
use crate::error::Error;

const SIZE: [f64; 3] = [0.081, 0.0268, 0.018];

/// One block of a size on the floor.
fn one(form: Form, size: [f64; 3], friction: f64, kinetic: Option<f64>) -> Scene {
    let block = Block { id: 0, size, mass: 0.0196, pos: [0.0, 0.0, 0.5 * size[2]], yaw: 0.0 };
    let scene = named("block").expect("the list has a block");
    Scene { friction, kinetic_friction: kinetic, form, blocks: vec![block], ..scene }
}

/// The only block.
const ONE: BodyId = BodyId(0);

/// Measures all of them.
pub fn measure(size: &Size) -> Result<Section, Error> {
    let mut section = Section::new(
        "closed",
        "Closed forms",
        "One block or a column of ten, where mechanics has a formula. A column is pulled at each of its blocks in turn by a force that grows until it slips. \
         Wood's grain is not modelled: friction is the same in all directions, which is measured here.",
    );
    let form = size.form;
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut row = |what: &str, measured: f64, expected: f64, unit: &str| {
        let off = format!("{:+.2} %", 100.0 * (measured / expected - 1.0));
        rows.push(vec![what.into(), format!("{measured:.5} {unit}"), format!("{expected:.5} {unit}"), off]);
        (measured / expected - 1.0).abs()
    };
    let (push, pushes) = column(size)?;
    section.goal("column push, furthest from Coulomb", format!("{:.2} %", 100.0 * push), "0.5 %", push <= 5e-3);
    let mut off = Vec::new();
    off.push(row(
        "distance until a block at 0.5 m/s stops, mu 0.4",
        stopping(form, 0.4, None)?,
        0.25 / (2.0 * 0.4 * 9.81),
        "m",
    ));
    off.push(row(
        "the same, static 0.5 and kinetic 0.3",
        stopping(form, 0.5, Some(0.3))?,
        0.25 / (2.0 * 0.3 * 9.81),
        "m",
    ));
    for direction in [0.0, 30.0, 45.0, 90.0_f64] {
        let (sin, cos) = libm::sincos(direction.to_radians());
        let world = settled(&one(form, SIZE, 0.4, None), params()).map_err(built)?;
        let force = breakaway_force(&world, ONE, DVec3::new(cos, sin, 0.0)).unwrap_or(f64::NAN);
        off.push(row(
            &format!("force that starts a block at {direction} degrees to its length"),
            force,
            0.4 * 0.0196 * 9.81,
            "N",
        ));
    }
    for mu in [0.25, 0.5] {
        let world = settled(&one(form, SIZE, mu, None), params()).map_err(built)?;
        let force = breakaway_force(&world, ONE, DVec3::X).unwrap_or(f64::NAN);
        off.push(row(&format!("force that starts a block, mu {mu}"), force, mu * 0.0196 * 9.81, "N"));
    }
    let kinetic = settled(&one(form, SIZE, 0.5, Some(0.35)), params()).map_err(built)?;
    let force = breakaway_force(&kinetic, ONE, DVec3::X).unwrap_or(f64::NAN);
    off.push(row("force that starts a block, static 0.5 and kinetic 0.35", force, 0.5 * 0.0196 * 9.81, "N"));
    section.goal(
        "slides and starts, furthest from Coulomb",
        format!("{:.2} %", 100.0 * largest(&off)),
        "1 %",
        largest(&off) <= 0.01,
    );

    let (holds, slides) = incline(form)?;
    section.goal(
        "incline at 0.998 of the angle of friction, creep in 10 s",
        format!("{holds:.1e} m"),
        "1e-8 m",
        holds < 1e-8,
    );
    section.goal("incline at 1.005 of it, way in 10 s", format!("{:.0} mm", 1e3 * slides), "slides", slides > 5e-3);

    let shapes = [[0.081, 0.0268, 0.018], [0.081, 0.018, 0.0268], [0.0268, 0.018, 0.018], [0.0268, 0.0268, 0.018]];
    let mut spins = Vec::new();
    for shape in shapes {
        let [a, b, _] = shape;
        let lever = torsion::rectangle_mean_distance(a, b);
        let inertia = 0.0196 * (a * a + b * b) / 12.0;
        let expected = 10.0 * inertia / (0.4 * 0.0196 * 9.81 * lever);
        let name = format!("time until a spin of 10 rad/s on a patch of {:.1} x {:.1} mm ends", 1e3 * a, 1e3 * b);
        spins.push(row(&name, spin_down(form, shape)?, expected, "s"));
    }
    section.say(
        "spins on patches of four shapes, furthest from a uniform pressure",
        format!("{:.1} %", 100.0 * largest(&spins)),
    );

    let mut bounces = Series { name: "mean of 40 drops".into(), line: true, ..Series::default() };
    for e in [0.45, 0.5, 0.55, 0.6] {
        let drops: Vec<u32> = (0..40).collect();
        let ratios = par_map(&drops, |&i| bounce(form, e, 0.01 + 1.37e-6 * f64::from(i)))
            .into_iter()
            .collect::<Result<Vec<f64>, _>>()?;
        bounces.points.push((e, mean(&ratios)));
        row(&format!("restitution of a flat drop, {e}"), mean(&ratios), e, "");
    }
    section.table(&["what", "measured", "expected", "off"], rows);
    section.data = json!({"pushes_over_coulomb": pushes, "restitution": bounces.points});
    section.plots.push(Plot {
        title: "Restitution of flat drops".into(),
        x: Axis::new("of the scene"),
        y: Axis::new("of the engine"),
        series: vec![bounces],
        diagonal: true,
    });
    Ok(section)
}

/// Pulls each block of a column both ways; the furthest from Coulomb's law, and all forces over it.
fn column(size: &Size) -> Result<(f64, Vec<f64>), Error> {
    let scene = size.formed(named("column").expect("the list has a column"));
    let blocks: Vec<u32> = (0..10).step_by(if size.quick { 4 } else { 1 }).collect();
    let world = settled(&scene, params()).map_err(built)?;
    let of = |&body: &u32| {
        let expected = scene.friction * scene.blocks[0].mass * scene.gravity * f64::from(10 - body);
        [DVec3::X, DVec3::NEG_X].map(|axis| breakaway_force(&world, BodyId(body), axis).unwrap_or(f64::NAN) / expected)
    };
    let ratios: Vec<f64> = par_map(&blocks, of).into_iter().flatten().collect();
    // a block that did not move counts as far off
    let off: Vec<f64> = ratios.iter().map(|r| if r.is_nan() { f64::INFINITY } else { (r - 1.0).abs() }).collect();
    Ok((largest(&off), ratios))
}

fn stopping(form: Form, friction: f64, kinetic: Option<f64>) -> Result<f64, Error> {
    let mut world = settled(&one(form, SIZE, friction, kinetic), params()).map_err(built)?;
    let start = world.pose(ONE).position.x;
    world.set_twist(ONE, Twist::linear(DVec3::new(0.5, 0.0, 0.0)));
    world.run_for(1.0);
    Ok(world.pose(ONE).position.x - start)
}

/// Way in 10 s a little below and a little above the angle of friction, m.
fn incline(form: Form) -> Result<(f64, f64), Error> {
    let way = |slope: f64| -> Result<f64, Error> {
        let mut world = World::new(&one(form, SIZE, 0.4, None), params()).map_err(built)?;
        let gravity = 9.81 / (1.0 + slope * slope).sqrt() * DVec3::new(slope, 0.0, -1.0);
        let input = Input::gravity(gravity);
        world.run_with(1.0, &input);
        let start = world.pose(ONE).position;
        world.run_with(10.0, &input);
        Ok(world.pose(ONE).position.distance(start))
    };
    Ok((way(0.4 * 0.998)?, way(0.4 * 1.005)?))
}

/// Time until a spinning block has a hundredth of its spin, scaled to all of it: friction takes it off evenly.
fn spin_down(form: Form, shape: [f64; 3]) -> Result<f64, Error> {
    let short = Params { frame: 1.0 / 2400.0, ..params() };
    let mut world = settled(&one(form, shape, 0.4, None), short).map_err(built)?;
    world.set_twist(ONE, Twist::angular(DVec3::new(0.0, 0.0, 10.0)));
    for i in 1..=world.frames(1.0) {
        world.step(&Input::default());
        if world.twist(ONE).spin.z < 0.1 {
            return Ok(i as f64 * short.frame / 0.99);
        }
    }
    Ok(f64::NAN)
}

/// Speed after over speed before a flat impact at 0.5 m/s from a height, without gravity.
fn bounce(form: Form, restitution: f64, height: f64) -> Result<f64, Error> {
    let mut scene = Scene { restitution, gravity: 0.0, ..one(form, SIZE, 0.4, None) };
    scene.blocks[0].pos[2] += height;
    let mut world = World::new(&scene, params()).map_err(built)?;
    world.set_twist(ONE, Twist::linear(DVec3::new(0.0, 0.0, -0.5)));
    world.run_for(0.1);
    Ok(world.twist(ONE).velocity.z / 0.5)
}
