//! Rotation of the tower above a block that is dragged by a short distance.

use glam::DVec3;
use teeter_physics::{BodyId, Grip, Hand, Input, World};

/// Force of the hand, N: more than any block of a tower resists with.
const FORCE: f64 = 20.0;

/// Straight motion of a hand.
///
/// ```
/// # use teeter_physics::{BodyId, Params};
/// # use teeter_scene::{TowerOptions, config};
/// # use teeter_study::{Drag, drag_rotation, long_axis, settled};
/// let scene = config("(101)-(010)", &TowerOptions::exact()).unwrap();
/// let world = settled(&scene, Params::default())?;
/// let drag = Drag { axis: long_axis(&scene.blocks[0]).extend(0.0), distance: 1e-3, speed: 5e-3 };
/// let rotation = |drag| drag_rotation(&world, BodyId(0), &[BodyId(2)], drag);
/// let forward = rotation(&drag);
/// // the opposite drag turns the block across in the opposite sense
/// let backward = rotation(&Drag { axis: -drag.axis, ..drag });
/// assert!(forward > 1.0 && (backward / forward + 1.0).abs() < 0.01);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// Direction, a level unit vector.
    pub axis: DVec3,
    /// Distance, m.
    pub distance: f64,
    /// Speed, m/s.
    pub speed: f64,
}

/// Drags the centre of `body` in a copy of a settled world by a hand that leaves it free to turn.
/// Returns the mean rotation of the blocks `above` about the vertical, for the travel of the body,
/// rad/m.
///
/// # Panics
/// When the world has no such body.
///
/// ```
/// use glam::DVec3;
/// use teeter_physics::{BodyId, Params};
/// use teeter_study::{Drag, drag_rotation, settled};
///
/// let world = settled(&teeter_scene::named("column").unwrap(), Params::default())?;
/// let drag = Drag { axis: DVec3::X, distance: 1e-3, speed: 5e-3 };
/// // a column has no lever arm to turn by
/// assert!(drag_rotation(&world, BodyId(3), &[BodyId(4)], &drag).abs() < 0.1);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn drag_rotation(settled: &World, body: BodyId, above: &[BodyId], drag: &Drag) -> f64 {
    let &Drag { axis, distance, speed } = drag;
    let mut world = settled.clone();
    let start = world.pose(body).position;
    let frames = world.frames(distance / speed).max(1);
    for i in 1..=frames {
        let hand = Hand {
            body,
            anchor: DVec3::ZERO,
            target: start + axis * (distance * i as f64 / frames as f64),
            orientation: None,
            grip: Grip::Slide,
            max_force: FORCE,
            max_torque: 0.0,
        };
        world.step(&Input::hand(hand));
    }
    let rotation = |&i: &BodyId| {
        let turn = world.pose(i).orientation * settled.pose(i).orientation.inverse();
        2.0 * libm::atan2(turn.z, turn.w)
    };
    let mean = above.iter().map(rotation).sum::<f64>() / above.len() as f64;
    mean / axis.dot(world.pose(body).position - start)
}
