//! Prototypes in the plane: abilities and limits of each method of chapter 2 on a stack.

use crate::common::cases;
use glam::DVec2;
use proptest::prelude::*;
use teeter_dissertation::flat::axes::{self, Tester};
use teeter_dissertation::flat::body::Body;
use teeter_dissertation::flat::lcp::{self, LcpError};
use teeter_dissertation::flat::manifold::Point;
use teeter_dissertation::flat::resting::{self, Contact};
use teeter_dissertation::flat::rigid::{Constants, Report};
use teeter_dissertation::flat::scene::{Rectangle, apart, section, stack};
use teeter_dissertation::flat::{Detection, Method, Rigid2D, Springs2D, springs};
use teeter_scene::named;

/// Summary of a run.
#[derive(Debug, Default)]
struct Run {
    max_iterations_used: u32,
    capped: u32,
    failures: u32,
    resting: u32,
}

fn run(world: &mut Rigid2D, seconds: f64) -> Run {
    let mut run = Run::default();
    for _ in 0..(seconds / world.constants.step) as u32 {
        let Report { iterations, capped, resting, failure } = world.step();
        run.max_iterations_used = run.max_iterations_used.max(iterations);
        run.capped += u32::from(capped);
        run.failures += u32::from(failure.is_some());
        run.resting = run.resting.max(resting);
    }
    run
}

fn highest(world: &Rigid2D) -> f64 {
    (0..world.len()).map(|n| world.pose(n).0.y).fold(0.0, f64::max)
}

/// A stack at rest stays at rest: Dantzig's algorithm finds the forces, and nothing collides.
#[test]
fn constraints_hold_a_resting_stack() {
    for count in [1, 2, 5, 10] {
        let mut world = Rigid2D::new(&stack(count, 0.0), Constants::of(Method::Constraint));
        let run = run(&mut world, 2.0);
        assert_eq!((run.capped, run.failures, run.resting), (0, 0, 2 * count), "{run:?}");
        assert!((highest(&world) - (f64::from(count) - 0.5) * 0.018).abs() < 1e-5);
    }
}

/// Figure 3.3: while a pair is resolved the others are ignored, so a falling stack needs ever more
/// iterations up to the limit. Springs yield instead, and need a few rounds at any height.
#[test]
fn a_falling_stack_reaches_the_limit_of_constraints() {
    let rigid = |count| run(&mut Rigid2D::new(&stack(count, 1e-3), Constants::of(Method::Constraint)), 1.0);
    let (one, three, eight) = (rigid(1), rigid(3), rigid(8));
    println!("{one:?}\n{three:?}\n{eight:?}");
    assert!(one.capped == 0 && one.max_iterations_used <= 2, "{one:?}");
    assert!(three.max_iterations_used > 5 * one.max_iterations_used, "{three:?}");
    assert!(
        eight.capped > 0 && eight.max_iterations_used == Constants::of(Method::Constraint).max_iterations,
        "{eight:?}"
    );
    for count in [1, 3, 8] {
        let mut world = Springs2D::new(&stack(count, 1e-3), springs::Constants::default());
        for _ in 0..4000 {
            let report = world.step();
            assert!(report.sweeps <= 3 && !report.unresolved, "{count}: {report:?}");
        }
        let (centre, turn) = world.pose(count as usize - 1);
        assert!(
            (centre.y - (f64::from(count) - 0.5) * 0.018).abs() < 1e-3 && turn.abs() < 0.01,
            "{count}: {centre} {turn}"
        );
    }
}

/// Each contact point of the penalty method has the depth of Eq. 2.12 for its share of the weight.
#[test]
fn penalty_depth_follows_the_weight() {
    let constants = Constants::of(Method::Penalty);
    let mut world = Rigid2D::new(&stack(4, 0.0), constants);
    run(&mut world, 2.0);
    let weight = 4.0 * 0.0196 * constants.gravity;
    let depth = 0.009 - world.pose(0).0.y;
    assert!((depth / (0.5 * weight / constants.stiffness) - 1.0).abs() < 0.01, "{depth}");
}

/// Micro-collisions carry a stack with a number of impulses that grows with the height.
#[test]
fn micro_collisions_carry_a_stack() {
    let mut max = [0; 2];
    for (count, max) in [1, 3].into_iter().zip(&mut max) {
        let mut world = Rigid2D::new(&stack(count, 0.0), Constants::of(Method::MicroCollisions));
        let run = run(&mut world, 1.0);
        *max = run.max_iterations_used;
        assert!((highest(&world) - (f64::from(count) - 0.5) * 0.018).abs() < 1e-4, "{count}");
    }
    assert!(max[1] > 3 * max[0], "{max:?}");
}

/// A section of a stable static test stands with every method that carries a stack.
#[test]
fn sections_of_scenes_stand() {
    let test_1 = section(&named("test-1").unwrap());
    assert_eq!(
        test_1.iter().map(|b| (b.size.x * 1e4).round()).collect::<Vec<_>>(),
        [810.0, 268.0, 810.0, 268.0, 810.0, 268.0]
    );
    assert_eq!(section(&named("tower").unwrap()).len(), 9 + 27);
    let mut world = Rigid2D::new(&test_1, Constants::of(Method::Penalty));
    run(&mut world, 1.0);
    assert!((highest(&world) - 5.5 * 0.018).abs() < 1e-3);
    let mut springs = Springs2D::new(&apart(&test_1, 1e-4), springs::Constants::default());
    for _ in 0..4000 {
        springs.step();
    }
    assert!((springs.pose(5).0.y - 5.5 * 0.018).abs() < 1e-3);
}

fn square(centre: DVec2, angle: f64) -> Body {
    Body { angle, ..Body::new(&Rectangle { size: DVec2::new(2.0, 1.0), mass: 1.0, centre }) }
}

/// Dantzig's algorithm on problems with no solution, or several.
#[test]
fn problems_without_a_solution_are_reported() {
    // No force acts on this acceleration.
    assert_eq!(lcp::solve(&[vec![0.0]], &[-1.0]), Err(LcpError::Unbounded(0)));
    // Two contacts at the same position share one load in any ratio; the solver loads one of them.
    let shared = lcp::solve(&[vec![1.0, 1.0], vec![1.0, 1.0]], &[-1.0, -1.0]).unwrap();
    assert_eq!(shared[0] + shared[1], 1.0);
}

proptest! {
    #![proptest_config(cases(2_000))]

    /// Solutions satisfy Eq. 2.13 to 2.15; with more degrees of freedom than contacts there always
    /// is one.
    #[test]
    fn solutions_satisfy_complementarity(rows in prop::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64], 1..5),
               b in [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64]) {
        let n = rows.len();
        let dot = |i: usize, j: usize| rows[i].iter().zip(rows[j]).map(|(x, y)| x * y).sum::<f64>();
        let matrix: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| dot(i, j)).collect()).collect();
        let f = lcp::solve(&matrix, &b[..n]).unwrap();
        for i in 0..n {
            let a: f64 = (0..n).map(|j| matrix[i][j] * f[j]).sum::<f64>() + b[i];
            let size = 1.0 + f.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
            prop_assert!(f[i] >= 0.0);
            prop_assert!(a >= -1e-9 * size, "{i}: {a}");
            prop_assert!((f[i] * a).abs() <= 1e-9 * size * size, "{i}: {} {a}", f[i]);
        }
    }

    /// Rectangles overlap by axes exactly if a point of a fine grid of one is in the other, up to
    /// the spacing of the grid.
    #[test]
    fn axes_and_points_agree(x in -2.5..2.5f64, y in -2.5..2.5f64, turn in 0.0..3.2f64) {
        let (a, b) = (square(DVec2::ZERO, 0.3), square(DVec2::new(x, y), turn));
        let (_, gap) = axes::max_separation(&a, &b);
        let inside = |body: &Body, p: DVec2| {
            let [u, v] = body.axes();
            (p - body.centre).dot(u).abs() <= body.half.x && (p - body.centre).dot(v).abs() <= body.half.y
        };
        let [u, v] = a.axes();
        let grid = |n: i32| f64::from(n) / 40.0;
        let any = (-40..=40).any(|i| (-40..=40).any(|j| inside(&b, a.centre + u * (a.half.x * grid(i)) + v * (a.half.y * grid(j)))));
        if gap > 0.0 { prop_assert!(!any); }
        if gap < -0.1 { prop_assert!(any); }
        prop_assert_eq!(Tester::new(false).overlap((0, 1), &a, &b, 0.0), gap < 0.0);
    }

    /// The moving test finds the first overlap of bodies that do not rotate, and samples find none
    /// before it.
    #[test]
    fn moving_axes_find_the_first_overlap(x in -4.0..4.0f64, y in -4.0..4.0f64, turn in 0.0..3.2f64, displacement in [-5.0..5.0, -5.0..5.0f64]) {
        let (a, b) = (square(DVec2::ZERO, 0.3), square(DVec2::new(x, y), turn));
        let displacement = DVec2::from(displacement);
        prop_assume!(axes::max_separation(&a, &b).1 > 0.01);
        let at = |t: f64| axes::max_separation(&a, &Body { centre: b.centre + t * displacement, ..b }).1;
        let found = Tester::new(false).first_overlap(&a, &b, displacement, 0.0);
        let sampled = (0..=500).map(|k| f64::from(k) / 500.0).find(|&t| at(t) < -1e-9);
        match (found, sampled) {
            (Some(t), sampled) => {
                prop_assert!(at(t).abs() < 1e-9);
                prop_assert!(sampled.is_none_or(|s| t <= s));
            }
            (None, sampled) => prop_assert!(sampled.is_none()),
        }
    }
}

/// Witnesses change no result and save axes; moving axes save tests where nothing rotates.
#[test]
fn witnesses_save_axes() {
    let fall = |witnesses, detection| {
        let constants = Constants { witnesses, detection, ..Constants::of(Method::Constraint) };
        let mut world = Rigid2D::new(&stack(3, 1e-3), constants);
        run(&mut world, 0.5);
        (world.bodies, world.tester.counters)
    };
    let (plain, without) = fall(false, Detection::Bisection);
    let (same, with) = fall(true, Detection::Bisection);
    assert_eq!(plain, same);
    println!("{without:?}\n{with:?}");
    assert!(with.witnesses > 0 && with.axes < without.axes, "{with:?} {without:?}");
    let (_, moving) = fall(true, Detection::MovingAxes);
    assert!(moving.pairs < with.pairs, "{moving:?} {with:?}");
}

/// The moving test misses a body that rotates into another without moving.
#[test]
fn moving_axes_miss_a_rotation() {
    let (still, upright) = (square(DVec2::ZERO, 0.0), square(DVec2::new(1.6, 0.0), std::f64::consts::FRAC_PI_2));
    assert!(axes::max_separation(&still, &upright).1 > 0.0);
    assert_eq!(Tester::new(false).first_overlap(&still, &upright, DVec2::ZERO, 0.0), None);
    assert!(axes::max_separation(&still, &square(DVec2::new(1.6, 0.0), 0.0)).1 < 0.0);
}

/// Impulses conserve momentum and add no energy, for any restitution.
#[test]
fn collisions_in_flight_conserve_momentum() {
    for restitution in [0.0, 0.5, 1.0] {
        for method in [Method::Constraint, Method::MicroCollisions] {
            let constants = Constants { restitution, gravity: 0.0, friction: 0.0, ..Constants::of(method) };
            let high =
                |y: f64, x: f64| Rectangle { size: DVec2::new(0.081, 0.018), mass: 0.0196, centre: DVec2::new(x, y) };
            let mut world = Rigid2D::new(&[high(1.0, 0.0), high(1.05, 0.03)], constants);
            world.bodies[1].velocity = DVec2::new(0.0, 0.5);
            world.bodies[2].velocity = DVec2::new(-0.1, -0.5);
            world.bodies[2].spin = 3.0;
            let momentum = |w: &Rigid2D| w.bodies[1].velocity + w.bodies[2].velocity;
            let energy = |w: &Rigid2D| w.bodies.iter().map(Body::energy).sum::<f64>();
            let (start, mut last) = (momentum(&world), energy(&world));
            let first = last;
            let mut hits = 0;
            for _ in 0..(0.3 / constants.step) as u32 {
                hits += world.step().iterations;
                assert!(momentum(&world).distance(start) < 1e-12);
                assert!(energy(&world) <= last * (1.0 + 1e-12), "{restitution} {method:?}");
                last = energy(&world);
            }
            assert!(hits > 0, "{method:?}");
            assert!(restitution == 1.0 || last < 0.99 * first);
        }
    }
}

/// A block that slides on the floor stops after v² / (2 mu g) with every method that has friction:
/// springs, penalty and micro-collisions.
#[test]
fn a_sliding_block_stops_at_its_distance() {
    let (speed, mu, gravity) = (0.3, 0.4, 9.81);
    let expected = speed * speed / (2.0 * mu * gravity);
    let mut springs = Springs2D::new(&apart(&stack(1, 0.0), 1e-5), springs::Constants::default());
    let settle = (0.2 / springs.constants.step) as u32;
    for _ in 0..settle {
        springs.step();
    }
    for state in &mut springs.curr {
        state.velocity.x = speed;
    }
    let start = springs.pose(0).0.x;
    for _ in 0..2 * settle {
        springs.step();
    }
    let slid = springs.pose(0).0.x - start;
    assert!((slid / expected - 1.0).abs() < 0.1, "springs: {slid} m, expected {expected}");
    for method in [Method::Penalty, Method::MicroCollisions] {
        let mut world = Rigid2D::new(&stack(1, 0.0), Constants::of(method));
        run(&mut world, 0.2);
        world.bodies[1].velocity.x = speed;
        let start = world.pose(0).0.x;
        run(&mut world, 0.4);
        let slid = world.pose(0).0.x - start;
        assert!((slid / expected - 1.0).abs() < 0.1, "{method:?}: {slid} m, expected {expected}");
    }
}

/// Force of one contact point on a body that spins and slides (Eq. 2.16): m (g - ω² h) where the
/// point is at h below the centre and the normal that of the floor; where the normal turns with the
/// body, its turning adds 2 ω v to the acceleration.
#[test]
fn a_spinning_body_has_the_acceleration_of_its_contact() {
    let (gravity, mass) = (9.81, 1.0);
    let force = |spin: f64, slide: f64, of_first: bool| {
        let mut body = square(DVec2::new(0.0, 0.5), 0.0);
        (body.spin, body.velocity.x) = (spin, slide);
        let point = Point { position: DVec2::ZERO, normal: DVec2::Y, of_first, depth: 0.0 };
        let contact = Contact { a: 1, b: 0, point };
        resting::forces(&[Body::floor(), body], &[contact], gravity).unwrap()[0]
    };
    let h = 0.5;
    for (spin, slide) in [(0.0, 0.0), (2.0, 0.0), (0.0, 1.0), (3.0, -1.0), (-3.0, 0.5)] {
        let centripetal = spin * spin * h;
        let fixed = mass * (gravity - centripetal);
        assert!((force(spin, slide, false) - fixed).abs() < 1e-12, "{spin} {slide}");
        // The point moves at slide + spin h, and the normal turns by the spin, towards -x.
        let turning = mass * (gravity - centripetal + 2.0 * spin * (slide + spin * h));
        assert!((force(spin, slide, true) - turning.max(0.0)).abs() < 1e-12, "{spin} {slide}");
    }
}

/// A contact slower than the limit reverses its whole velocity whatever the restitution, and so
/// keeps the energy of a block that begins to fall; above the limit the restitution counts.
#[test]
fn a_micro_collision_reverses_the_whole_velocity() {
    for restitution in [0.0, 0.3] {
        let constants = Constants { restitution, friction: 0.0, ..Constants::of(Method::MicroCollisions) };
        let kept = |constants: Constants| {
            let mut world = Rigid2D::new(&stack(1, 0.0), constants);
            let report = world.step();
            assert!(report.iterations > 0 && !report.capped, "{report:?}");
            let fall = constants.gravity * constants.step;
            world.bodies[1].energy() / (0.5 * fall * fall * 0.0196)
        };
        // Far above the velocities of the corners, which the first impulse at one of them doubles.
        let micro = kept(Constants { rest_velocity: 1.0, ..constants });
        assert!((micro - 1.0).abs() < 1e-9, "{restitution}: {micro}");
        let plain = kept(Constants { rest_velocity: 0.0, ..constants });
        assert!(plain < 0.5, "{restitution}: {plain}");
    }
}
