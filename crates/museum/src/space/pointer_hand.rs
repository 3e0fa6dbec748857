//! Hand of 2003: a block is picked by a ray and dragged with the left button in the plane of the
//! screen, with the right one in depth (sections 4.8, 4.8.1 and 5.6).
//!
//! It has no guides: the target is where the pointer is, however far and fast it goes. It does not
//! turn a block, and nothing but its contacts keeps a block from turning.

use glam::DVec3;
use serde::Deserialize;
use teeter_dissertation::jenga3d::hand::{drag_in_depth, drag_in_plane};
use teeter_dissertation::jenga3d::pick::{Ray, pick};
use teeter_dissertation::jenga3d::{Hand, Jenga3D};

/// Pointer on the screen, as a ray from the camera.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pointer {
    /// Position of the camera, m.
    origin: DVec3,
    /// Direction through the pointer, of any length.
    direction: DVec3,
    /// The camera's z axis: unit vector from the screen to the viewer.
    toward_viewer: DVec3,
}

impl Pointer {
    fn ray(&self) -> Ray {
        Ray { origin: self.origin, direction: self.direction }
    }

    fn is_valid(&self) -> bool {
        let vectors = [self.origin, self.direction, self.toward_viewer];
        vectors.iter().all(|v| v.is_finite()) && self.direction != DVec3::ZERO && self.toward_viewer.is_normalized()
    }
}

/// Request of the player, carried out before the next frame.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(tag = "request", rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    /// Picks the first block under the pointer.
    Pick {
        /// Pointer.
        pointer: Pointer,
    },
    /// Drags the block in the plane of the screen: the left button.
    Drag {
        /// Pointer.
        pointer: Pointer,
    },
    /// Drags the block along the line of sight: the right button.
    Pull {
        /// Displacement towards the viewer since the last request, m.
        distance: f64,
        /// The camera's z axis.
        toward_viewer: DVec3,
    },
    /// Goes on with the block as it is, for a pointer or a camera that has moved meanwhile.
    Resume {
        /// Pointer.
        pointer: Pointer,
    },
    /// Lets go.
    Release,
}

impl Request {
    /// Returns true if all vectors are finite, and directions have a direction.
    pub fn is_valid(&self) -> bool {
        match self {
            Request::Pick { pointer } | Request::Drag { pointer } | Request::Resume { pointer } => pointer.is_valid(),
            Request::Pull { distance, toward_viewer } => distance.is_finite() && toward_viewer.is_normalized(),
            Request::Release => true,
        }
    }
}

/// Motion of the hand.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Motion {
    /// In the plane through the block's centre that is parallel to the screen.
    Plane {
        pointer: Pointer,
        /// Point under the pointer from the centre when it was picked, m: a press moves nothing.
        grip: DVec3,
    },
    /// Along the line of sight.
    Depth {
        toward_viewer: DVec3,
        /// Target of the centre along it, m.
        target: f64,
    },
}

/// Hand with or without a block.
#[derive(Debug, Clone, Copy, Default)]
pub struct PointerHand {
    held: Option<(u32, Motion)>,
}

impl PointerHand {
    /// Index of the held block.
    pub fn block(&self) -> Option<u32> {
        self.held.map(|(block, _)| block)
    }

    /// Carries out a request.
    pub fn take(&mut self, request: &Request, jenga: &Jenga3D) {
        self.held = match (*request, self.held) {
            (Request::Pick { pointer }, _) => {
                let picked = pick(&jenga.model, &jenga.curr, &pointer.ray());
                picked.map(|(block, _)| (block, in_plane(jenga, block, pointer)))
            }
            (Request::Resume { pointer }, Some((block, _))) => Some((block, in_plane(jenga, block, pointer))),
            (Request::Drag { pointer }, Some((block, Motion::Plane { grip, .. }))) => {
                Some((block, Motion::Plane { pointer, grip }))
            }
            (Request::Drag { pointer }, Some((block, Motion::Depth { .. }))) => {
                Some((block, in_plane(jenga, block, pointer)))
            }
            (Request::Pull { distance, toward_viewer }, Some((block, motion))) => {
                let target = match motion {
                    Motion::Depth { target, .. } => target,
                    Motion::Plane { .. } => centre(jenga, block).dot(toward_viewer),
                };
                Some((block, Motion::Depth { toward_viewer, target: target + distance }))
            }
            (Request::Release, _) | (_, None) => None,
        };
    }

    /// Hand for the next frame.
    pub fn hand(&self, jenga: &Jenga3D) -> Option<Hand> {
        let (block, motion) = self.held?;
        let centre = centre(jenga, block);
        let target = match motion {
            Motion::Plane { pointer, grip } => {
                drag_in_plane(&pointer.ray(), pointer.toward_viewer, centre).map_or(centre, |point| point - grip)
            }
            Motion::Depth { toward_viewer, target } => {
                drag_in_depth(toward_viewer, centre, target - centre.dot(toward_viewer))
            }
        };
        Some(Hand { block, target })
    }
}

fn centre(jenga: &Jenga3D, block: u32) -> DVec3 {
    jenga.model.blocks[block as usize].centre(&jenga.curr)
}

/// Motion in the plane of the screen that begins where the block is.
fn in_plane(jenga: &Jenga3D, block: u32, pointer: Pointer) -> Motion {
    let centre = centre(jenga, block);
    let point = drag_in_plane(&pointer.ray(), pointer.toward_viewer, centre);
    Motion::Plane { pointer, grip: point.map_or(DVec3::ZERO, |point| point - centre) }
}

#[cfg(test)]
mod tests {
    use teeter_dissertation::jenga3d::{Constants, HandMode};
    use teeter_scene::{TowerOptions, named, tower};

    use super::*;

    /// Pointer of a camera that views along -x, at a height of the picture and a position across.
    fn pointer(across: f64, height: f64) -> Pointer {
        let origin = DVec3::new(0.5, 0.0, 0.05);
        Pointer { origin, direction: DVec3::new(0.0, across, height) - origin, toward_viewer: DVec3::X }
    }

    fn settled(scene: &teeter_scene::Scene, hand: HandMode) -> Jenga3D {
        let mut jenga = Jenga3D::new(scene, Constants { hand, ..Constants::default() }).unwrap();
        for _ in 0..30 {
            jenga.frame(None);
        }
        jenga
    }

    fn play(jenga: &mut Jenga3D, hand: &mut PointerHand, request: Request, frames: u32) {
        hand.take(&request, jenga);
        for _ in 0..frames {
            let target = hand.hand(jenga);
            jenga.frame(target.as_ref());
        }
    }

    #[test]
    fn a_ray_picks_the_first_block_and_a_press_moves_nothing() {
        let scene = tower(&TowerOptions { rows: 3, ..TowerOptions::default() }).unwrap();
        let jenga = settled(&scene, HandMode::Hybrid);
        let mut hand = PointerHand::default();
        // The middle of the second row's side, which faces +x: its blocks lie along y.
        hand.take(&Request::Pick { pointer: pointer(0.0, 0.027) }, &jenga);
        let block = hand.block().expect("a block is there");
        let centres = jenga.centres();
        let nearest = (3..6).max_by(|&a, &b| centres[a].x.total_cmp(&centres[b].x)).unwrap();
        assert_eq!(block as usize, nearest);
        let target = hand.hand(&jenga).unwrap().target;
        assert!(target.distance(centres[nearest]) < 1e-12, "{target}");
        hand.take(&Request::Pick { pointer: pointer(0.3, 0.027) }, &jenga);
        assert_eq!(hand.block(), None);
    }

    /// The left button moves across the view, the right one along it, and neither in the direction
    /// of the other.
    #[test]
    fn both_drags_move_a_block_in_the_air() {
        let mut jenga = settled(&named("block").unwrap(), HandMode::Hybrid);
        let mut hand = PointerHand::default();
        let start = jenga.centres()[0];
        play(&mut jenga, &mut hand, Request::Pick { pointer: pointer(0.0, 0.009) }, 1);
        // Of the ray to (0, 0.02, 0.109) the part within the plane of the centre.
        let lift = Request::Drag { pointer: pointer(0.02, 0.109) };
        play(&mut jenga, &mut hand, lift, 90);
        let lifted = jenga.centres()[0];
        let expected = DVec3::new(start.x, 0.02, 0.109);
        let plane_scale = (0.5 - start.x) / 0.5;
        assert!((lifted.y - expected.y * plane_scale).abs() < 2e-3, "{lifted}");
        assert!((lifted.x - start.x).abs() < 2e-3 && lifted.z > 0.09, "{lifted}");
        let pull = |distance| Request::Pull { distance, toward_viewer: DVec3::X };
        play(&mut jenga, &mut hand, pull(0.02), 1);
        play(&mut jenga, &mut hand, pull(0.03), 60);
        let pulled = jenga.centres()[0];
        assert!((pulled.x - lifted.x - 0.05).abs() < 1e-3, "{pulled} {lifted}");
        assert!((pulled.y - lifted.y).abs() < 1e-3, "{pulled} {lifted}");
        play(&mut jenga, &mut hand, Request::Release, 60);
        assert!(hand.block().is_none() && jenga.centres()[0].z < 0.02);
    }

    /// Section 5.6: the velocity is stronger than a tower, the force is a spring in the air.
    #[test]
    fn the_three_methods_differ_as_described() {
        let reach = |hand_mode| {
            let mut jenga = settled(&named("block").unwrap(), hand_mode);
            let mut hand = PointerHand::default();
            play(&mut jenga, &mut hand, Request::Pick { pointer: pointer(0.0, 0.009) }, 1);
            play(&mut jenga, &mut hand, Request::Drag { pointer: pointer(0.0, 0.15) }, 120);
            let mut heights = Vec::new();
            for _ in 0..60 {
                let target = hand.hand(&jenga);
                jenga.frame(target.as_ref());
                heights.push(jenga.centres()[0].z);
            }
            let [min, max] =
                [f64::min as fn(f64, f64) -> f64, f64::max].map(|f| heights.iter().copied().reduce(f).unwrap());
            max - min
        };
        assert!(reach(HandMode::Force) > 0.02, "a block bounces around the pointer");
        assert!(reach(HandMode::Velocity) < 1e-3);
        assert!(reach(HandMode::Hybrid) < 1e-3);
    }

    /// No limit of force or speed: a flick takes a loaded block out within a few frames.
    #[test]
    fn a_flick_draws_a_loaded_block_at_two_metres_a_second() {
        let scene = tower(&TowerOptions { rows: 6, ..TowerOptions::exact() }).unwrap();
        let mut jenga = settled(&scene, HandMode::Hybrid);
        let mut hand = PointerHand::default();
        // The end of the middle block of the third row, which lies along x.
        play(&mut jenga, &mut hand, Request::Pick { pointer: pointer(0.0, 0.045) }, 1);
        let block = hand.block().unwrap() as usize;
        let start = jenga.centres()[block].x;
        let mut max_speed = 0.0f64;
        for _ in 0..6 {
            play(&mut jenga, &mut hand, Request::Pull { distance: 2.0 / 60.0, toward_viewer: DVec3::X }, 1);
            max_speed = max_speed.max(jenga.model.blocks[block].velocity(&jenga.curr).x);
        }
        assert!(max_speed > 1.9, "{max_speed} m/s");
        assert!(jenga.centres()[block].x - start > 0.081, "it is out after a tenth of a second");
    }

    #[test]
    fn requests_without_a_direction_are_not_valid() {
        assert!(Request::Pick { pointer: pointer(0.0, 0.0) }.is_valid());
        for broken in [
            Pointer { direction: DVec3::ZERO, ..pointer(0.0, 0.0) },
            Pointer { toward_viewer: DVec3::splat(1.0), ..pointer(0.0, 0.0) },
            Pointer { origin: DVec3::NAN, ..pointer(0.0, 0.0) },
        ] {
            assert!(!Request::Drag { pointer: broken }.is_valid(), "{broken:?}");
        }
        assert!(!Request::Pull { distance: f64::INFINITY, toward_viewer: DVec3::X }.is_valid());
    }
}
