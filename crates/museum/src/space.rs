//! Jenga3D behind the border: a frame at a time, with what the page wants to know of it.

use std::collections::BTreeMap;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_dissertation::jenga3d::block::{CORNERS, SPRINGS};
use teeter_dissertation::jenga3d::contact::FLOOR;
use teeter_dissertation::jenga3d::counters::Counters;
use teeter_dissertation::jenga3d::{Constants, Disabling, Hand, HandMode, Jenga3D};
use teeter_scene::Scene;
use wasm_bindgen::prelude::*;

use crate::Error;
use crate::fit;

/// The 3-D simulator of 2003, owned and stepped by a worker.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Space {
    jenga: Jenga3D,
    /// Half the edge lengths of each block, m.
    halves: Vec<DVec3>,
    /// Places in a block's springs of those between particles 0 and 1, 0 and 2, ... 6 and 7.
    order: [usize; SPRINGS],
    poses: Vec<f64>,
    lattices: Vec<f32>,
    /// What pairs of blocks did to each other in the last frame; the normal points to the first.
    loads: BTreeMap<[u32; 2], Load>,
}

/// Sums over the contacts of a pair in the steps of a frame.
#[derive(Debug, Clone, Copy, Default)]
struct Load {
    /// Of the forces on the first block, N.
    force: DVec3,
    /// Of their sizes, N.
    size: f64,
    /// Of the places, weighted by them, N m.
    moment: DVec3,
}

/// What a hand wants.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Grasp {
    body: u32,
    /// Where the block's centre is wanted, m.
    target: [f64; 3],
}

/// What a frame did.
#[derive(Serialize)]
struct Report {
    /// Simulated time, s.
    time: f64,
    /// Blocks that are not disabled.
    active: usize,
    /// Pairs of blocks that collided.
    touching: usize,
    /// Velocity of the fastest block, m/s.
    max_speed: f64,
    /// Most rounds over the pairs in a step.
    rounds: u32,
    /// Steps that ended with collisions left.
    unresolved: u32,
    /// Tests of the last step.
    tests: Counters,
    hand: Option<HandReport>,
}

/// What the hand did at the end of a frame.
#[derive(Serialize)]
struct HandReport {
    /// Its force, N; null while it writes the block's velocity, which no force bounds.
    force: Option<[f64; 3]>,
}

/// A loaded contact of a block, in the mean over the last frame.
#[derive(Serialize)]
struct Contact {
    /// The other block; null for the floor.
    other: Option<u32>,
    /// m.
    point: [f64; 3],
    /// Direction in which the other presses.
    normal: [f64; 3],
    /// N.
    force: f64,
}

#[wasm_bindgen]
impl Space {
    /// The blocks of a scene (JSON), by the usual constants; with `future` also what section 6.3 leaves for later: static friction, and rest
    /// by the motion of blocks as a whole.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, future: bool) -> Result<Space, Error> {
        let scene = Scene::from_json(scene).map_err(Error::rejected)?;
        let usual = Constants { friction: scene.friction, gravity: scene.gravity, ..Constants::default() };
        let constants = if future {
            Constants { static_friction: Some(scene.friction), disabling: Disabling::Rigid, ..usual }
        } else {
            usual
        };
        let jenga = Jenga3D::new(&scene, constants).map_err(Error::rejected)?;
        let ends: Vec<[u32; 2]> = jenga.model.springs[..SPRINGS].iter().map(|s| [s.p1, s.p2]).collect();
        let pairs = (0..CORNERS as u32).flat_map(|a| (a + 1..CORNERS as u32).map(move |b| [a, b]));
        let mut order = [0; SPRINGS];
        for (place, pair) in order.iter_mut().zip(pairs) {
            *place = ends.iter().position(|e| *e == pair).expect("a spring joins every two particles");
        }
        let halves = scene.blocks.iter().map(|b| 0.5 * DVec3::from(b.size)).collect();
        let mut space = Self { jenga, halves, order, poses: Vec::new(), lattices: Vec::new(), loads: BTreeMap::new() };
        space.fit();
        Ok(space)
    }

    /// Advances by a sixtieth of a second under a hand (JSON of `{"body", "target"}`: where the block's centre is wanted, m; empty text for
    /// none), and gives the report as JSON. A hand on a block that does not exist is an error, and everything stays as it was.
    pub fn step(&mut self, hand: &str) -> Result<String, Error> {
        let grasp: Option<Grasp> = if hand.trim().is_empty() {
            None
        } else {
            Some(serde_json::from_str(hand).map_err(|e| Error::json("hand", e))?)
        };
        if let Some(grasp) = &grasp {
            self.check(grasp.body)?;
            if !grasp.target.iter().all(|x| x.is_finite()) {
                return Err(Error::rejected("hand: `target` is no place"));
            }
        }
        let hand = grasp.map(|g| Hand { block: g.body, target: g.target.into() });
        let report = self.frame(hand.as_ref());
        serde_json::to_string(&report).map_err(|e| Error::json("report", e))
    }

    /// Where the poses lie in wasm memory: seven doubles a block, position (m) and orientation (x, y, z, w) of the rigid block nearest to the
    /// particles. Any later call may move them, so make the view anew.
    #[wasm_bindgen(js_name = posesPtr)]
    pub fn poses_ptr(&self) -> *const f64 {
        self.poses.as_ptr()
    }

    /// Writes down the particles and springs of all blocks and says where they lie in wasm memory: 52 floats a block, the places of its 8
    /// particles (m) and the forces of its 28 springs (N, pulling is positive; between particles 0 and 1, 0 and 2, ... 6 and 7). Bit k of a
    /// particle's number says on which side of axis k of the block it is. Any later call may move them, so make the view anew.
    #[wasm_bindgen(js_name = latticesPtr)]
    pub fn lattices_ptr(&mut self) -> *const f32 {
        self.lattices.clear();
        let Jenga3D { model, curr, .. } = &self.jenga;
        for block in &model.blocks {
            self.lattices.extend(curr[block.corners()].iter().flat_map(|s| s.position.as_vec3().to_array()));
            let springs = &model.springs[block.springs as usize..][..SPRINGS];
            let pull = |n: &usize| springs[*n].stiffness * (springs[*n].length(curr) - springs[*n].rest_length);
            self.lattices.extend(self.order.iter().map(|n| pull(n) as f32));
        }
        self.lattices.as_ptr()
    }

    /// Number of blocks.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.halves.len()
    }

    /// Edge lengths of all blocks, three numbers each, m.
    pub fn sizes(&self) -> Vec<f32> {
        self.halves.iter().flat_map(|half| (2.0 * half).as_vec3().to_array()).collect()
    }

    /// The contacts of a block in the mean over the last frame as JSON: `[{"other", "point", "normal", "force"}]`.
    pub fn contacts(&self, body: u32) -> Result<String, Error> {
        self.check(body)?;
        let steps = f64::from(self.jenga.constants.mid_loop_count);
        let contacts: Vec<Contact> = self
            .loads
            .iter()
            .filter(|(pair, load)| pair.contains(&body) && load.size > 0.0)
            .map(|(&[to, from], load)| {
                let (other, force) = if to == body { (from, load.force) } else { (to, -load.force) };
                Contact {
                    other: (other != FLOOR).then_some(other),
                    point: (load.moment / load.size).to_array(),
                    normal: force.normalize_or_zero().to_array(),
                    force: force.length() / steps,
                }
            })
            .collect();
        serde_json::to_string(&contacts).map_err(|e| Error::json("contacts", e))
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.jenga.time
    }

    /// Force of the hand per distance between block and target, N/m.
    #[wasm_bindgen(getter, js_name = handStiffness)]
    pub fn hand_stiffness(&self) -> f64 {
        self.jenga.constants.hand_stiffness
    }
}

impl Space {
    fn check(&self, body: u32) -> Result<(), Error> {
        let count = self.length();
        if (body as usize) < count {
            Ok(())
        } else {
            Err(Error::rejected(format!("there is no block {body}: the tower has {count}")))
        }
    }

    fn frame(&mut self, hand: Option<&Hand>) -> Report {
        self.loads.clear();
        let (mut rounds, mut unresolved, mut tests) = (0, 0, Counters::default());
        for _ in 0..self.jenga.constants.mid_loop_count {
            let counts = self.jenga.step(hand);
            rounds = rounds.max(counts.sweeps);
            unresolved += counts.unresolved;
            tests = counts.first;
            self.weigh();
        }
        self.fit();
        let Jenga3D { model, curr, time, .. } = &self.jenga;
        Report {
            time: *time,
            active: model.blocks.iter().filter(|b| b.active).count(),
            touching: self.loads.keys().filter(|pair| pair[1] != FLOOR).count(),
            max_speed: model.blocks.iter().map(|b| b.velocity(curr).length()).fold(0.0, f64::max),
            rounds,
            unresolved,
            tests,
            hand: hand.map(|hand| HandReport { force: self.force(hand).map(|f| f.to_array()) }),
        }
    }

    /// Adds the contacts of the last step to the loads.
    fn weigh(&mut self) {
        for contact in &self.jenga.contacts {
            let [a, b] = contact.blocks;
            // One entry a pair, whichever side the normal points to.
            let (pair, sign) = if a < b { ([a, b], 1.0) } else { ([b, a], -1.0) };
            let at: DVec3 =
                contact.parts().filter(|(_, w)| *w > 0.0).map(|(p, w)| w * self.jenga.curr[p].position).sum();
            let load = self.loads.entry(pair).or_default();
            load.force += sign * contact.normal_force * contact.normal;
            load.size += contact.normal_force;
            load.moment += contact.normal_force * at;
        }
    }

    /// The force of the hand on its block as it is now, N; none where it writes the velocity.
    fn force(&self, hand: &Hand) -> Option<DVec3> {
        let Jenga3D { model, curr, constants, .. } = &self.jenga;
        let by_force = match constants.hand {
            HandMode::Force => true,
            HandMode::Velocity => false,
            HandMode::Hybrid => self.loads.keys().any(|pair| pair.contains(&hand.block)),
        };
        by_force.then(|| constants.hand_stiffness * (hand.target - model.blocks[hand.block as usize].centre(curr)))
    }

    fn fit(&mut self) {
        self.poses.clear();
        let Jenga3D { model, curr, .. } = &self.jenga;
        for (block, half) in model.blocks.iter().zip(&self.halves) {
            let first = block.corners().start;
            let (centre, turn) = fit::pose(&std::array::from_fn(|c| curr[first + c].position), *half);
            self.poses.extend(centre.to_array().into_iter().chain(turn.to_array()));
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, Vec3};
    use serde_json::Value;

    use super::*;

    const ONE: &str = r#"{"name": "one", "friction": 0.4, "blocks": [
        {"id": 0, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009], "yaw": 0.5}]}"#;
    const TWO: &str = r#"{"name": "two", "friction": 0.4, "blocks": [
        {"id": 0, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009]},
        {"id": 1, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.027]}]}"#;

    fn read(text: &str) -> Value {
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn a_block_at_the_start_has_its_pose_of_the_scene() {
        let space = Space::new(ONE, false).unwrap();
        assert_eq!((space.length(), space.poses.len()), (1, 7));
        let centre = DVec3::from_slice(&space.poses);
        // Raised by the row spacing.
        assert!(centre.distance(DVec3::new(0.0, 0.0, 0.0091)) < 1e-12, "{centre}");
        let turn = DQuat::from_slice(&space.poses[3..]);
        assert!(turn.dot(DQuat::from_rotation_z(0.5)).abs() > 1.0 - 1e-12, "{turn}");
        assert_eq!(space.sizes(), [0.081, 0.0268, 0.018]);
    }

    /// What collides at rest carries the weight in the mean: the impulses of the contacts make up for gravity.
    #[test]
    fn contacts_carry_the_weight() {
        let mut space = Space::new(TWO, false).unwrap();
        for _ in 0..60 {
            space.step("").unwrap();
        }
        let (mut lower, mut upper, frames) = (0.0, 0.0, 30);
        for _ in 0..frames {
            space.step("").unwrap();
            for contact in read(&space.contacts(0).unwrap()).as_array().unwrap() {
                let along = contact["force"].as_f64().unwrap() * contact["normal"][2].as_f64().unwrap();
                if contact["other"].is_null() { lower += along } else { upper += along }
            }
        }
        let weight = 0.0196 * 9.81;
        let (lower, upper) = (lower / f64::from(frames), upper / f64::from(frames));
        assert!((lower / (2.0 * weight) - 1.0).abs() < 0.02, "{lower}");
        assert!((upper / -weight - 1.0).abs() < 0.02, "{upper}");
    }

    /// One particle drawn out pulls at its seven springs, each as far as it has become longer, and at no other.
    #[test]
    fn springs_in_the_order_of_their_particles() {
        let mut space = Space::new(ONE, false).unwrap();
        let moved = DVec3::new(0.0, 0.0, 1e-3);
        space.jenga.curr[7].position += moved;
        space.lattices_ptr();
        assert_eq!(space.lattices.len(), 52);
        assert_eq!(Vec3::from_slice(&space.lattices[21..]), space.jenga.curr[7].position.as_vec3());
        let ends = (0..8).flat_map(|a| (a + 1..8).map(move |b| (a, b)));
        for ((a, b), pull) in ends.zip(&space.lattices[24..]) {
            let apart = fit::corner(b, space.halves[0]) - fit::corner(a, space.halves[0]);
            let stretch = if b == 7 { (apart + moved).length() - apart.length() } else { 0.0 };
            let expected = space.jenga.constants.stiffness * stretch;
            assert!((f64::from(*pull) - expected).abs() < 1e-5, "{a} and {b}: {pull} N, expected {expected}");
        }
    }

    /// A block in the air goes where the hand is: its velocity is written, so the rest of the way shrinks by e in each twentieth of a second.
    #[test]
    fn the_hand_carries_a_block() {
        let mut space = Space::new(ONE, false).unwrap();
        let hand = r#"{"body": 0, "target": [0, 0, 0.1]}"#;
        for _ in 0..60 {
            space.step(hand).unwrap();
        }
        let report = read(&space.step(hand).unwrap());
        assert!(report["hand"]["force"].is_null(), "{report}");
        assert!((space.poses[2] - 0.1).abs() < 1e-3, "{}", space.poses[2]);
    }

    #[test]
    fn what_cannot_be_is_told_in_one_line() {
        for scene in ["{", "[]", r#"{"name": "none", "friction": 0.4, "blocks": []}"#] {
            let line = Space::new(scene, false).unwrap_err().to_string();
            assert!(!line.is_empty() && !line.contains('\n'), "{line}");
        }
        let mut space = Space::new(ONE, true).unwrap();
        let before = space.time();
        assert_eq!(
            space.step(r#"{"body": 3, "target": [0, 0, 0]}"#).unwrap_err().to_string(),
            "there is no block 3: the tower has 1"
        );
        assert!(space.step("{}").unwrap_err().to_string().starts_with("hand: "));
        assert!(space.contacts(1).is_err());
        assert_eq!(space.time(), before);
    }
}
