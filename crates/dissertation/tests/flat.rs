//! The prototypes in the plane: what each method of chapter 2 can do with a stack, and what it cannot.

mod common;

use common::cases;
use glam::DVec2;
use proptest::prelude::*;
use teeter_dissertation::flat::axes::{self, Tester};
use teeter_dissertation::flat::body::Body;
use teeter_dissertation::flat::lcp::{self, LcpError};
use teeter_dissertation::flat::rigid::{Constants, Report};
use teeter_dissertation::flat::scene::{Rectangle, apart, section, stack};
use teeter_dissertation::flat::{Detection, Method, Rigid2D, Springs2D, springs};
use teeter_scene::named;

/// What a second or two of a world was like.
#[derive(Debug, Default)]
struct Run {
    most_iterations: u32,
    capped: u32,
    failures: u32,
    resting: u32,
}

fn run(world: &mut Rigid2D, seconds: f64) -> Run {
    let mut run = Run::default();
    for _ in 0..(seconds / world.constants.step) as u32 {
        let Report { iterations, capped, resting, failure } = world.step();
        run.most_iterations = run.most_iterations.max(iterations);
        run.capped += u32::from(capped);
        run.failures += u32::from(failure.is_some());
        run.resting = run.resting.max(resting);
    }
    run
}

fn highest(world: &Rigid2D) -> f64 {
    (0..world.len()).map(|n| world.pose(n).0.y).fold(0.0, f64::max)
}

/// A stack that begins at rest stays there: Dantzig's algorithm finds the forces, and nothing collides.
#[test]
fn constraints_hold_what_rests() {
    for count in [1, 2, 5, 10] {
        let mut world = Rigid2D::new(&stack(count, 0.0), Constants::of(Method::Constraint));
        let run = run(&mut world, 2.0);
        assert_eq!((run.capped, run.failures, run.resting), (0, 0, 2 * count), "{run:?}");
        assert!((highest(&world) - (f64::from(count) - 0.5) * 0.018).abs() < 1e-5);
    }
}

/// Figure 3.3: while one pair is resolved the others are ignored, so that a stack that falls onto itself needs ever more iterations, until the
/// limit ends what would not end by itself. Springs give way instead, and need no more than a couple of rounds however high the stack is.
#[test]
fn a_stack_that_falls_onto_itself() {
    let rigid = |count| run(&mut Rigid2D::new(&stack(count, 1e-3), Constants::of(Method::Constraint)), 1.0);
    let (one, three, eight) = (rigid(1), rigid(3), rigid(8));
    println!("{one:?}\n{three:?}\n{eight:?}");
    assert!(one.capped == 0 && one.most_iterations <= 2, "{one:?}");
    assert!(three.most_iterations > 5 * one.most_iterations, "{three:?}");
    assert!(eight.capped > 0 && eight.most_iterations == Constants::of(Method::Constraint).max_iterations, "{eight:?}");
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

/// The penalty method carries a stack by its depth: each contact point is as deep as Eq. 2.12 says for its share of the weight.
#[test]
fn penalty_depth() {
    let constants = Constants::of(Method::Penalty);
    let mut world = Rigid2D::new(&stack(4, 0.0), constants);
    run(&mut world, 2.0);
    let weight = 4.0 * 0.0196 * constants.gravity;
    let depth = 0.009 - world.pose(0).0.y;
    assert!((depth / (0.5 * weight / constants.stiffness) - 1.0).abs() < 0.01, "{depth}");
}

/// Micro-collisions carry it too, at a price in impulses that grows with the height.
#[test]
fn micro_collisions_carry_a_stack() {
    let mut most = [0; 2];
    for (count, most) in [1, 3].into_iter().zip(&mut most) {
        let mut world = Rigid2D::new(&stack(count, 0.0), Constants::of(Method::MicroCollisions));
        let run = run(&mut world, 1.0);
        *most = run.most_iterations;
        assert!((highest(&world) - (f64::from(count) - 0.5) * 0.018).abs() < 1e-4, "{count}");
    }
    assert!(most[1] > 3 * most[0], "{most:?}");
}

/// The bottom rows of the dissertation's tests as sections: a stable one stands by every method that can carry a stack.
#[test]
fn sections_of_scenes() {
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

/// Dantzig's algorithm where there is no answer, or more than one.
#[test]
fn problems_without_a_solution_are_reported() {
    // Nothing stops what no force reaches.
    assert_eq!(lcp::solve(&[vec![0.0]], &[-1.0]), Err(LcpError::Unbounded(0)));
    // One load on two contacts at the same place: any share will do, and one of them carries all.
    let shared = lcp::solve(&[vec![1.0, 1.0], vec![1.0, 1.0]], &[-1.0, -1.0]).unwrap();
    assert_eq!(shared[0] + shared[1], 1.0);
}

proptest! {
    #![proptest_config(cases(2_000))]

    /// Eq. 2.13 to 2.15 hold for what is solved; with more motions than contacts everything is.
    #[test]
    fn dantzig(rows in prop::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64], 1..5),
               b in [-1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0, -1.0..1.0f64]) {
        let n = rows.len();
        let dot = |i: usize, j: usize| rows[i].iter().zip(rows[j]).map(|(x, y)| x * y).sum::<f64>();
        let matrix: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| dot(i, j)).collect()).collect();
        let f = lcp::solve(&matrix, &b[..n]).unwrap();
        for i in 0..n {
            let a: f64 = (0..n).map(|j| matrix[i][j] * f[j]).sum::<f64>() + b[i];
            let size = 1.0 + f.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            prop_assert!(f[i] >= 0.0);
            prop_assert!(a >= -1e-9 * size, "{i}: {a}");
            prop_assert!((f[i] * a).abs() <= 1e-9 * size * size, "{i}: {} {a}", f[i]);
        }
    }

    /// Overlap by axes is overlap by points: two rectangles overlap exactly when some point of a fine grid of one is in the other, but for what
    /// is thinner than the grid.
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

    /// The moving test finds the first overlap of bodies that do not turn: apart just before, together just after, and none missed by samples.
    #[test]
    fn moving_axes(x in -4.0..4.0f64, y in -4.0..4.0f64, turn in 0.0..3.2f64, way in [-5.0..5.0, -5.0..5.0f64]) {
        let (a, b) = (square(DVec2::ZERO, 0.3), square(DVec2::new(x, y), turn));
        let way = DVec2::from(way);
        prop_assume!(axes::max_separation(&a, &b).1 > 0.01);
        let at = |t: f64| axes::max_separation(&a, &Body { centre: b.centre + t * way, ..b }).1;
        let found = Tester::new(false).first_overlap(&a, &b, way, 0.0);
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

/// Witnesses change no result and save axes; moving axes save them too, where nothing turns.
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

/// The moving test does not see a turn: two bodies that are beside each other and do not move, one of which turns into the other.
#[test]
fn moving_axes_miss_a_turn() {
    let (still, upright) = (square(DVec2::ZERO, 0.0), square(DVec2::new(1.6, 0.0), std::f64::consts::FRAC_PI_2));
    assert!(axes::max_separation(&still, &upright).1 > 0.0);
    assert_eq!(Tester::new(false).first_overlap(&still, &upright, DVec2::ZERO, 0.0), None);
    assert!(axes::max_separation(&still, &square(DVec2::new(1.6, 0.0), 0.0)).1 < 0.0);
}

/// Impulses conserve momentum and never add energy, whatever the restitution.
#[test]
fn collisions_in_flight() {
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
