//! Runs of one block on the floor, and of a column.

use glam::DVec3;
use teeter_physics::{BodyId, Input, Params, Twist, World};
use teeter_scene::{Block, Form, Scene, named};
use teeter_study::{par_map, settled};

use crate::error::Error;
use crate::validation::size::{Size, params};

/// Gravitational acceleration, m/s².
pub const G: f64 = 9.81;
/// Coefficient of friction where none is named.
pub const FRICTION: f64 = 0.4;
/// Initial speed of sliding blocks, m/s.
pub const SPEED: f64 = 0.5;
/// Initial spin of spinning blocks, rad/s.
pub const SPIN: f64 = 10.0;
/// Mass of a block, kg.
pub const MASS: f64 = 0.0196;
/// Edges of a block, m.
const SIZE: [f64; 3] = [0.081, 0.0268, 0.018];
/// Blocks of the column.
const COLUMN: u32 = 10;
/// The only block of a scene.
const BLOCK: BodyId = BodyId(0);

/// Coefficients of static and kinetic friction; none for the same.
type Friction = (f64, Option<f64>);

/// Scene of one block with edges `size` (m) on the floor.
fn block(form: Form, size: [f64; 3], (friction, kinetic_friction): Friction) -> Scene {
    let block = Block::new(0, size, MASS, [0.0, 0.0, 0.5 * size[2]]);
    let scene = named("block").expect("the list of scenes has a block");
    Scene { friction, kinetic_friction, form, blocks: vec![block], ..scene }
}

/// Breakaway forces of the blocks of a column, in both directions, over Coulomb's; not a number
/// where a block does not move.
pub fn column(size: &Size) -> Result<Vec<f64>, Error> {
    let scene = size.with_form(named("column").expect("the list of scenes has a column"));
    let blocks: Vec<u32> = (0..COLUMN).step_by(if size.quick { 4 } else { 1 }).collect();
    let world = settled(&scene, params())?;
    let ratios = |&body: &u32| {
        let expected = scene.friction * scene.blocks[0].mass * scene.gravity * f64::from(COLUMN - body);
        let force = |axis| teeter_study::breakaway_force(&world, BodyId(body), axis).unwrap_or(f64::NAN);
        [DVec3::X, DVec3::NEG_X].map(|axis| force(axis) / expected)
    };
    Ok(par_map(&blocks, ratios).into_iter().flatten().collect())
}

/// Distance after which a block at [`SPEED`] stops, m.
pub fn stopping_distance(form: Form, friction: f64, kinetic: Option<f64>) -> Result<f64, Error> {
    let mut world = settled(&block(form, SIZE, (friction, kinetic)), params())?;
    let start = world.pose(BLOCK).position.x;
    world.set_twist(BLOCK, Twist::linear(DVec3::new(SPEED, 0.0, 0.0)));
    world.run_for(1.0);
    Ok(world.pose(BLOCK).position.x - start)
}

/// Force along `axis` that starts a block, N; not a number where it does not move.
pub fn breakaway_force(form: Form, friction: Friction, axis: DVec3) -> Result<f64, Error> {
    let world = settled(&block(form, SIZE, friction), params())?;
    Ok(teeter_study::breakaway_force(&world, BLOCK, axis).unwrap_or(f64::NAN))
}

/// Displacement of a block in 10 s on a slope, m.
pub fn incline_displacement(form: Form, slope: f64) -> Result<f64, Error> {
    let mut world = World::new(&block(form, SIZE, (FRICTION, None)), params())?;
    let input = Input::gravity(G / (1.0 + slope * slope).sqrt() * DVec3::new(slope, 0.0, -1.0));
    world.run_with(1.0, &input);
    let start = world.pose(BLOCK).position;
    world.run_with(10.0, &input);
    Ok(world.pose(BLOCK).position.distance(start))
}

/// Time after which a block with edges `size` (m) that begins with [`SPIN`] no longer spins, s,
/// from that until it has a hundredth of its spin: friction is constant.
pub fn spin_time(form: Form, size: [f64; 3]) -> Result<f64, Error> {
    let short = Params { frame: 1.0 / 2400.0, ..params() };
    let mut world = settled(&block(form, size, (FRICTION, None)), short)?;
    world.set_twist(BLOCK, Twist::angular(DVec3::new(0.0, 0.0, SPIN)));
    for i in 1..=world.frames(1.0) {
        world.step(&Input::default());
        if world.twist(BLOCK).spin.z < 0.01 * SPIN {
            return Ok(i as f64 * short.frame / 0.99);
        }
    }
    Ok(f64::NAN)
}

/// Speed after over speed before a flat impact at [`SPEED`] from a height (m), without gravity.
pub fn bounce(form: Form, restitution: f64, height: f64) -> Result<f64, Error> {
    let mut scene = Scene { restitution, gravity: 0.0, ..block(form, SIZE, (FRICTION, None)) };
    scene.blocks[0].pos[2] += height;
    let mut world = World::new(&scene, params())?;
    world.set_twist(BLOCK, Twist::linear(DVec3::new(0.0, 0.0, -SPEED)));
    world.run_for(0.1);
    Ok(world.twist(BLOCK).velocity.z / SPEED)
}
