//! The prototypes in the plane behind the border: blocks that a pointer can pull, with the counters of their method.

use glam::DVec2;
use serde::{Deserialize, Serialize};
use teeter_dissertation::flat::manifold::Point;
use teeter_dissertation::flat::resting::Touch;
use teeter_dissertation::flat::scene::{Rectangle, apart, section, stack};
use teeter_dissertation::flat::{Method as Rigid, Rigid2D, Springs2D, constraint, rigid, springs};
use teeter_scene::TowerOptions;
use wasm_bindgen::prelude::*;

use crate::Error;

/// Most blocks in a scene: the work grows with the square of their number.
const MOST_BLOCKS: usize = 16;
/// Force of the pointer per distance between the point that it holds and itself, N/m, and per velocity of that point, N s/m.
const HAND: (f64, f64) = (40.0, 0.8);
/// Largest force of the pointer, N: the weight of a dozen blocks.
const HAND_FORCE: f64 = 2.5;
/// How far beside a block a pointer may be that takes it, m.
const REACH: f64 = 0.004;
/// How far apart rows of blocks of springs begin that would otherwise begin on each other, m.
const SPACING: f64 = 1e-4;
/// How far apart blocks are at most that count as touching, m.
const TOUCHING: f64 = 5e-5;

/// What is done at contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Method {
    Springs,
    Constraint,
    Penalty,
    MicroCollisions,
}

/// What stands there at the beginning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Setting {
    /// Blocks upon each other.
    Stack,
    /// The same apart from each other, so that they fall.
    Falling,
    /// A section through a tower of six rows whose blocks differ in height.
    Tower,
}

/// What to build.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Options {
    method: Method,
    setting: Setting,
    /// Number of blocks of a stack.
    count: u32,
    /// How far apart those that fall are, m.
    #[serde(default)]
    gap: f64,
    /// Of the springs or of the penalty method, N/m; the usual one where absent.
    #[serde(default)]
    stiffness: Option<f64>,
}

/// A prototype in the plane.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Plane {
    method: Method,
    world: World,
    sizes: Vec<DVec2>,
    corners: Vec<f64>,
    time: f64,
    hand: Option<Hand>,
    counts: Counts,
}

#[derive(Debug)]
enum World {
    Rigid(Rigid2D),
    Springs(Springs2D),
}

/// A pointer that holds a block.
#[derive(Debug, Clone, Copy)]
struct Hand {
    block: usize,
    /// The point that it holds, in parts of the block's edges from its lower left corner.
    at: DVec2,
    /// Where it is, m.
    target: DVec2,
}

/// What the steps did.
#[derive(Debug, Clone, Copy, Default, Serialize)]
struct Counts {
    /// Simulated time, s.
    time: f64,
    /// Pairs resolved, impulses, or rounds over the pairs, of the last step.
    iterations: u32,
    /// The same of the step that took most, since the report before.
    most: u32,
    /// Steps cut short since the beginning, with pairs left over.
    cut: u32,
    /// Steps since the beginning for whose resting contacts no forces were found.
    unsolved: u32,
    /// Contact points at rest, where there is such a thing; else points that touch.
    points: usize,
    /// Tests of the last step: axes of rigid bodies, points against edges of springs.
    tests: u64,
    /// How deep blocks are inside each other, m.
    overlap: f64,
}

#[wasm_bindgen]
impl Plane {
    /// Builds a scene: JSON of `{"method", "setting", "count", "gap", "stiffness"}`, the method `springs`, `constraint`, `penalty` or
    /// `micro-collisions`, the setting `stack`, `falling` or `tower`, the gap in m, the stiffness in N/m.
    #[wasm_bindgen(constructor)]
    pub fn new(options: &str) -> Result<Plane, Error> {
        let options: Options = serde_json::from_str(options).map_err(|e| Error::json("options", e))?;
        check(&options)?;
        let Options { method, setting, count, gap, stiffness } = options;
        let blocks = match setting {
            Setting::Stack => stack(count, 0.0),
            Setting::Falling => stack(count, gap),
            Setting::Tower => {
                let tower = TowerOptions { rows: 6, ..TowerOptions::default() };
                section(&teeter_scene::tower(&tower).map_err(Error::rejected)?)
            }
        };
        let sizes = blocks.iter().map(|b| b.size).collect();
        let world = match kind(method) {
            Some(kind) => {
                let usual = rigid::Constants::of(kind);
                World::Rigid(Rigid2D::new(
                    &blocks,
                    rigid::Constants { stiffness: stiffness.unwrap_or(usual.stiffness), ..usual },
                ))
            }
            None => {
                let usual = springs::Constants::default();
                let blocks = if setting == Setting::Falling { blocks } else { apart(&blocks, SPACING) };
                World::Springs(Springs2D::new(
                    &blocks,
                    springs::Constants { stiffness: stiffness.unwrap_or(usual.stiffness), ..usual },
                ))
            }
        };
        Ok(Self { method, world, sizes, corners: Vec::new(), time: 0.0, hand: None, counts: Counts::default() })
    }

    /// Time of a step, s.
    #[wasm_bindgen(getter)]
    pub fn step(&self) -> f64 {
        match &self.world {
            World::Rigid(world) => world.constants.step,
            World::Springs(world) => world.constants.step,
        }
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Number of blocks.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.sizes.len()
    }

    /// Advances by some steps.
    pub fn advance(&mut self, steps: u32) {
        for _ in 0..steps {
            self.pull();
            self.time += self.step();
            match &mut self.world {
                World::Rigid(world) => {
                    let before = world.tester.counters.axes;
                    let report = world.step();
                    self.counts.iterations = report.iterations;
                    self.counts.cut += u32::from(report.capped);
                    self.counts.unsolved += u32::from(report.failure.is_some());
                    self.counts.tests = world.tester.counters.axes - before;
                }
                World::Springs(world) => {
                    let report = world.step();
                    self.counts.iterations = report.sweeps;
                    self.counts.cut += u32::from(report.unresolved);
                    let blocks = world.len() as u64;
                    // Four points against four edges, both ways.
                    self.counts.tests = u64::from(report.sweeps) * 32 * (blocks * blocks.saturating_sub(1) / 2);
                }
            }
            self.counts.most = self.counts.most.max(self.counts.iterations);
        }
    }

    /// Writes down the corners of all blocks and says where they lie in wasm memory: eight doubles a block, counter-clockwise from the lower
    /// left, x to the right and y up, m. Any later call may move them, so make the view anew.
    #[wasm_bindgen(js_name = cornersPtr)]
    pub fn corners_ptr(&mut self) -> *const f64 {
        let Self { world, corners, .. } = self;
        corners.clear();
        match world {
            World::Rigid(world) => {
                corners.extend(world.bodies[1..].iter().flat_map(|b| b.corners()).flat_map(|c| c.to_array()))
            }
            World::Springs(world) => corners.extend(world.curr.iter().flat_map(|s| s.position.to_array())),
        }
        corners.as_ptr()
    }

    /// The contact points, five numbers each: place (m), unit normal, and the force along it (N), which is zero where the method knows none.
    /// None of springs, whose blocks only ever collide.
    pub fn contacts(&self) -> Vec<f64> {
        let World::Rigid(world) = &self.world else { return Vec::new() };
        let (touches, forces) = match self.method {
            Method::Constraint => {
                let (touches, forces) = constraint::resting(world);
                let none = vec![0.0; touches.len()];
                (touches, forces.unwrap_or(none))
            }
            _ => {
                let touches = world.touches(TOUCHING);
                let push = |depth: f64| {
                    if self.method == Method::Penalty { world.constants.stiffness * depth.max(0.0) } else { 0.0 }
                };
                let forces = touches.iter().map(|t| push(t.point.depth)).collect();
                (touches, forces)
            }
        };
        let numbers = |(touch, force): (Touch, f64)| {
            let Point { place, normal, .. } = touch.point;
            [place.x, place.y, normal.x, normal.y, force]
        };
        touches.into_iter().zip(forces).flat_map(numbers).collect()
    }

    /// What the steps did, as JSON; begins to count the most iterations anew.
    pub fn report(&mut self) -> Result<String, Error> {
        self.counts.time = self.time;
        if let World::Rigid(world) = &self.world {
            let touches = world.touches(TOUCHING);
            self.counts.points = match self.method {
                Method::Constraint => constraint::resting(world).0.len(),
                _ => touches.len(),
            };
            self.counts.overlap = touches.iter().map(|t| t.point.depth).fold(0.0, f64::max);
        }
        let text = serde_json::to_string(&self.counts).map_err(|e| Error::json("report", e))?;
        self.counts.most = 0;
        Ok(text)
    }

    /// One more block, level, with its centre at (x, y) (m) and a velocity (m/s).
    pub fn add(&mut self, x: f64, y: f64, vx: f64, vy: f64) -> Result<(), Error> {
        if self.sizes.len() >= MOST_BLOCKS {
            return Err(Error::rejected(format!("there are {MOST_BLOCKS} blocks, no more fit")));
        }
        if ![x, y, vx, vy].iter().all(|v| v.is_finite()) {
            return Err(Error::rejected("a block needs a place and a velocity"));
        }
        let one = stack(1, 0.0)[0];
        let block = Rectangle { centre: DVec2::new(x, y), ..one };
        let (n, velocity) = (self.sizes.len(), DVec2::new(vx, vy));
        match &mut self.world {
            World::Rigid(world) => {
                world.add(&block);
                world.bodies[n + 1].velocity = velocity;
            }
            World::Springs(world) => {
                world.add(&block);
                world.push(n, DVec2::splat(0.5), velocity * block.mass);
            }
        }
        self.sizes.push(block.size);
        Ok(())
    }

    /// Holds the block at a place (m), if there is one.
    pub fn hold(&mut self, x: f64, y: f64) -> bool {
        let place = DVec2::new(x, y);
        let nearest = |block: usize| {
            let (centre, turn) = self.pose(block);
            let local = DVec2::from_angle(-turn).rotate(place - centre);
            let half = 0.5 * self.sizes[block];
            let beside = (local.abs() - half).max(DVec2::ZERO).length();
            (beside, (local.clamp(-half, half) + half) / self.sizes[block])
        };
        let best = (0..self.length()).map(|b| (b, nearest(b))).min_by(|(_, a), (_, b)| a.0.total_cmp(&b.0));
        self.hand =
            best.filter(|(_, (beside, _))| *beside <= REACH).map(|(block, (_, at))| Hand { block, at, target: place });
        self.hand.is_some()
    }

    /// Moves the pointer that holds a block, m.
    pub fn drag(&mut self, x: f64, y: f64) {
        if let Some(hand) = &mut self.hand {
            hand.target = DVec2::new(x, y);
        }
    }

    /// Lets go.
    pub fn release(&mut self) {
        self.hand = None;
    }

    /// The held point and the pointer, four numbers, m; nothing where none is held.
    pub fn held(&self) -> Vec<f64> {
        let of = |hand: Hand| {
            let (place, _) = self.point(hand.block, hand.at);
            vec![place.x, place.y, hand.target.x, hand.target.y]
        };
        self.hand.map(of).unwrap_or_default()
    }
}

impl Plane {
    fn pose(&self, block: usize) -> (DVec2, f64) {
        match &self.world {
            World::Rigid(world) => world.pose(block),
            World::Springs(world) => world.pose(block),
        }
    }

    /// Place (m) and velocity (m/s) of a point of a block, in parts of its edges.
    fn point(&self, block: usize, at: DVec2) -> (DVec2, DVec2) {
        match &self.world {
            World::Rigid(world) => {
                let body = &world.bodies[block + 1];
                let [x, y] = body.axes();
                let local = (2.0 * at - 1.0) * body.half;
                let place = body.centre + local.x * x + local.y * y;
                (place, body.velocity_at(place))
            }
            World::Springs(world) => {
                let state = world.point(block, at);
                (state.position, state.velocity)
            }
        }
    }

    /// The pointer's force over one step.
    fn pull(&mut self) {
        let Some(Hand { block, at, target }) = self.hand else { return };
        let (place, velocity) = self.point(block, at);
        let impulse = (HAND.0 * (target - place) - HAND.1 * velocity).clamp_length_max(HAND_FORCE) * self.step();
        match &mut self.world {
            World::Rigid(world) => world.bodies[block + 1].push(impulse, place),
            World::Springs(world) => world.push(block, at, impulse),
        }
    }
}

/// The method of rigid bodies; springs are none.
fn kind(method: Method) -> Option<Rigid> {
    match method {
        Method::Springs => None,
        Method::Constraint => Some(Rigid::Constraint),
        Method::Penalty => Some(Rigid::Penalty),
        Method::MicroCollisions => Some(Rigid::MicroCollisions),
    }
}

fn check(options: &Options) -> Result<(), Error> {
    let refuse = |line: String| Err(Error::Rejected(line));
    if !(1..=MOST_BLOCKS as u32).contains(&options.count) {
        return refuse(format!("`count` is {}, expected 1 to {MOST_BLOCKS}", options.count));
    }
    if !(0.0..=0.1).contains(&options.gap) {
        return refuse(format!("`gap` is {}, expected 0 to 0.1 m", options.gap));
    }
    match options.stiffness {
        // The steps are made for the usual stiffness of 2e4 N/m.
        Some(stiffness) if !(50.0..=2e4).contains(&stiffness) => {
            refuse(format!("`stiffness` is {stiffness}, expected 50 to 2e4 N/m"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    const METHODS: [&str; 4] = ["springs", "constraint", "penalty", "micro-collisions"];

    fn plane(method: &str, setting: &str, count: u32) -> Plane {
        Plane::new(&format!(r#"{{"method": "{method}", "setting": "{setting}", "count": {count}, "gap": 0.004}}"#))
            .unwrap()
    }

    fn seconds(plane: &mut Plane, time: f64) -> Value {
        plane.advance((time / plane.step()) as u32);
        serde_json::from_str(&plane.report().unwrap()).unwrap()
    }

    fn corners(plane: &mut Plane) -> Vec<DVec2> {
        plane.corners_ptr();
        plane.corners.chunks(2).map(DVec2::from_slice).collect()
    }

    #[test]
    fn a_block_has_four_corners_counter_clockwise() {
        for method in METHODS {
            let mut plane = plane(method, "stack", 3);
            let c = corners(&mut plane);
            assert_eq!((plane.length(), c.len()), (3, 12));
            for block in c.chunks(4) {
                let area: f64 = 0.5 * (0..4).map(|i| block[i].perp_dot(block[(i + 1) % 4])).sum::<f64>();
                assert!((area - 0.081 * 0.018).abs() < 1e-12, "{method}: {area}");
            }
        }
    }

    /// The whole weight of what stands goes through the points on the floor.
    #[test]
    fn forces_at_rest() {
        for (method, within) in [("constraint", 1e-9), ("penalty", 0.01)] {
            let mut plane = plane(method, "stack", 4);
            seconds(&mut plane, 2.0);
            let floor: f64 = plane.contacts().chunks(5).filter(|c| c[1].abs() < 1e-3).map(|c| c[3].abs() * c[4]).sum();
            let weight = 4.0 * 0.0196 * 9.81;
            assert!((floor / weight - 1.0).abs() < within, "{method}: {floor} of {weight}");
        }
    }

    /// Figure 3.3: a stack that falls onto itself ends at the limit; one of springs needs a couple of rounds (Figure 3.5).
    #[test]
    fn figures_3_3_and_3_5() {
        let fallen = seconds(&mut plane("constraint", "falling", 8), 0.5);
        assert!(fallen["cut"].as_u64().unwrap() > 0 && fallen["most"] == 1000, "{fallen}");
        let fallen = seconds(&mut plane("springs", "falling", 8), 0.5);
        assert!(fallen["cut"] == 0 && fallen["most"].as_u64().unwrap() <= 3, "{fallen}");
    }

    /// The pointer draws what it holds after it, by the point that it holds.
    #[test]
    fn a_pointer_pulls_a_block() {
        for method in METHODS {
            let mut plane = plane(method, "stack", 1);
            assert!(!plane.hold(0.2, 0.2));
            assert!(plane.held().is_empty());
            // By its centre: by another point it would swing for long.
            assert!(plane.hold(0.0, 0.009));
            plane.drag(0.1, 0.05);
            seconds(&mut plane, 2.0);
            let held = plane.held();
            let (at, pointer) = (DVec2::new(held[0], held[1]), DVec2::new(held[2], held[3]));
            // Then it hangs on the pointer's spring: the weight over the stiffness lower.
            let hangs = DVec2::new(0.0, -0.0196 * 9.81 / HAND.0);
            assert!(at.distance(pointer + hangs) < 1e-4, "{method}: {at} {pointer}");
            plane.release();
            seconds(&mut plane, 1.0);
            assert!(plane.pose(0).0.y < 0.045, "{method}: {}", plane.pose(0).0);
        }
    }

    /// A block that is added falls freely: y = y0 - g t²/2.
    #[test]
    fn one_more_block() {
        for method in METHODS {
            let mut plane = plane(method, "stack", 1);
            plane.add(0.0, 0.5, 0.1, 0.0).unwrap();
            let time = 0.2;
            seconds(&mut plane, time);
            let expected = DVec2::new(0.1 * time, 0.5 - 0.5 * 9.81 * time * time);
            assert!(
                plane.pose(1).0.distance(expected) < 9.81 * time * plane.step() + 1e-6,
                "{method}: {}",
                plane.pose(1).0
            );
            while plane.length() < MOST_BLOCKS {
                plane.add(0.0, 1.0, 0.0, 0.0).unwrap();
            }
            assert_eq!(plane.add(0.0, 1.0, 0.0, 0.0).unwrap_err().to_string(), "there are 16 blocks, no more fit");
            assert!(plane.add(f64::NAN, 1.0, 0.0, 0.0).is_err());
        }
    }

    #[test]
    fn a_section_of_a_tower_stands_by_every_method_with_friction() {
        for method in ["springs", "penalty", "micro-collisions"] {
            let mut plane = plane(method, "tower", 1);
            let top = |plane: &Plane| (0..plane.length()).map(|b| plane.pose(b).0.y).fold(0.0, f64::max);
            let before = top(&plane);
            seconds(&mut plane, 0.5);
            // The blocks of springs begin apart; to fall would be half a block's height.
            assert!((top(&plane) - before).abs() < 2e-3, "{method}: {} then {}", before, top(&plane));
        }
    }

    #[test]
    fn what_cannot_be_is_told_in_one_line() {
        for options in [
            "",
            r#"{"method": "magic", "setting": "stack", "count": 3}"#,
            r#"{"method": "springs", "setting": "stack", "count": 0}"#,
            r#"{"method": "springs", "setting": "falling", "count": 3, "gap": -1}"#,
            r#"{"method": "springs", "setting": "stack", "count": 3, "stiffness": 1e9}"#,
        ] {
            let line = Plane::new(options).unwrap_err().to_string();
            assert!(!line.is_empty() && !line.contains('\n'), "{line}");
        }
    }
}
