//! Parity: every operation of every width gives the bits of the scalar operation.

use super::lanes::{Lanes, ROW_LEN, Real, RowRegister};
use super::portable;

/// Length of an array that every register divides.
const LEN: usize = 16;

/// Numbers that expose differences in rounding, signs, zeros and infinities.
fn samples<R: Real>() -> Vec<[R; LEN]> {
    let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
    let mut number = || {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        let mantissa = (bits >> 11) as f64 / (1u64 << 53) as f64;
        let power = [1e-12, 1e-6, 1.0, 1e3, 1e20][(bits % 5) as usize];
        if bits & 32 == 0 { mantissa * power } else { -mantissa * power }
    };
    let mut all: Vec<[R; LEN]> = (0..200).map(|_| std::array::from_fn(|_| R::from_f64(number()))).collect();
    let odd = [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e-40, -1e-40, 1e-310, -1e-310];
    all.extend((0..odd.len()).map(|k| std::array::from_fn(|i| R::from_f64(odd[(i + k) % odd.len()]))));
    all
}

fn bits<R: Real>(x: [R; LEN]) -> [u64; LEN] {
    // The payload of a NaN may differ between targets.
    x.map(|x| if x.to_f64().is_nan() { u64::MAX } else { x.to_f64().to_bits() })
}

/// Applies an operation to an array, register by register.
fn in_lanes<L: Lanes>(x: &[L::Scalar; LEN], y: &[L::Scalar; LEN], op: impl Fn(L, L) -> L) -> [u64; LEN] {
    let mut out = [L::Scalar::default(); LEN];
    for part in 0..LEN / L::WIDTH {
        op(L::load(x, part), L::load(y, part)).store(&mut out, part);
    }
    bits(out)
}

/// Applies an operation to each scalar.
fn in_scalars<R: Real>(x: &[R; LEN], y: &[R; LEN], op: impl Fn(R, R) -> R) -> [u64; LEN] {
    bits(std::array::from_fn(|i| op(x[i], y[i])))
}

fn agrees<L: Lanes>() {
    let all = samples::<L::Scalar>();
    arithmetic_agrees::<L>(&all);
    masks_agree::<L>(&all[0]);
    transposition_agrees::<L>(&all);
}

fn arithmetic_agrees<L: Lanes>(all: &[[L::Scalar; LEN]]) {
    let zero = L::Scalar::default();
    for (x, y) in all.iter().zip(all.iter().rev()) {
        assert_eq!(in_lanes::<L>(x, y, |a, b| a + b), in_scalars(x, y, |a, b| a + b));
        assert_eq!(in_lanes::<L>(x, y, |a, b| a - b), in_scalars(x, y, |a, b| a - b));
        assert_eq!(in_lanes::<L>(x, y, |a, b| a * b), in_scalars(x, y, |a, b| a * b));
        assert_eq!(in_lanes::<L>(x, y, |a, b| a / b), in_scalars(x, y, |a, b| a / b));
        assert_eq!(in_lanes::<L>(x, y, |a, b| a.min(b)), in_scalars(x, y, |a, b| if a < b { a } else { b }));
        assert_eq!(in_lanes::<L>(x, y, |a, _| -a), in_scalars(x, y, |a, _| -a));
        assert_eq!(in_lanes::<L>(x, y, |a, _| a.sqrt()), in_scalars(x, y, |a, _| a.sqrt()));
        let add_assigned = |mut a: L, b: L| {
            a += b;
            a
        };
        let sub_assigned = |mut a: L, b: L| {
            a -= b;
            a
        };
        assert_eq!(in_lanes::<L>(x, y, add_assigned), in_scalars(x, y, |a, b| a + b));
        assert_eq!(in_lanes::<L>(x, y, sub_assigned), in_scalars(x, y, |a, b| a - b));
        assert_eq!(
            in_lanes::<L>(x, y, |a, b| L::select(a.less_than(b), a, b)),
            in_scalars(x, y, |a, b| if a < b { a } else { b })
        );
        assert_eq!(
            in_lanes::<L>(x, y, |a, b| L::mask(a.less_than(b), a)),
            in_scalars(x, y, |a, b| if a < b { a } else { zero })
        );
        for part in 0..LEN / L::WIDTH {
            let lanes = L::WIDTH * part..L::WIDTH * (part + 1);
            let any = L::any(L::load(x, part).less_than(L::load(y, part)));
            assert_eq!(any, lanes.clone().any(|i| x[i] < y[i]));
            assert_eq!(bits([L::load(x, part).first(); LEN]), bits([x[lanes.start]; LEN]));
        }
        assert_eq!(in_lanes::<L>(x, y, |_, _| L::splat(x[3])), bits([x[3]; LEN]));
    }
}

fn masks_agree<L: Lanes>(x: &[L::Scalar; LEN]) {
    let zero = L::Scalar::default();
    assert_eq!(in_lanes::<L>(x, x, |_, _| L::zero()), bits([zero; LEN]));
    assert_eq!(in_lanes::<L>(x, x, |_, _| L::splat_f64(0.1)), bits([L::Scalar::from_f64(0.1); LEN]));
    for lane in 0..LEN {
        // A mask that is set in a single lane.
        let one: [L::Scalar; LEN] = std::array::from_fn(|i| L::Scalar::from_f64(if i == lane { -1.0 } else { 1.0 }));
        for part in 0..LEN / L::WIDTH {
            let (there, mask) = (lane / L::WIDTH == part, L::load(&one, part).less_than(L::zero()));
            assert_eq!(L::any(mask), there);
        }
    }
}

fn transposition_agrees<L: Lanes>(all: &[[L::Scalar; LEN]]) {
    let zero = L::Scalar::default();
    for rows in all.chunks_exact(LEN) {
        let row =
            |l: usize| -> [L::Scalar; ROW_LEN] { std::array::from_fn(|i| if i % 4 == 3 { zero } else { rows[l][i] }) };
        let columns = L::columns(|l| L::Row::read(&row(l)));
        for (i, column) in columns.into_iter().enumerate() {
            let mut out = [zero; LEN];
            column.store(&mut out, 0);
            assert_eq!(
                bits(out)[..L::WIDTH],
                bits(std::array::from_fn(|l| if l < L::WIDTH { row(l)[i] } else { zero }))[..L::WIDTH]
            );
        }
        let mut count = 0;
        for (l, back) in L::rows(columns).into_iter().enumerate() {
            let mut out = [zero; ROW_LEN];
            back.write(&mut out);
            assert_eq!(out.map(|x| x.to_f64().to_bits()), row(l).map(|x| x.to_f64().to_bits()));
            count += 1;
        }
        assert_eq!(count, L::WIDTH);
        let (a, b) = (L::Row::read(&row(0)), L::Row::read(&row(1)));
        let mut sums = [[zero; ROW_LEN]; 2];
        (a + b).write(&mut sums[0]);
        (a - b).write(&mut sums[1]);
        for (i, (x, y)) in row(0).into_iter().zip(row(1)).enumerate() {
            let same = |x: L::Scalar, y: L::Scalar| {
                x.to_f64().to_bits() == y.to_f64().to_bits() || x.to_f64().is_nan() && y.to_f64().is_nan()
            };
            assert!(same(sums[0][i], x + y) && same(sums[1][i], x - y));
        }
    }
}

#[test]
fn all_widths_give_the_bits_of_the_scalar() {
    agrees::<portable::Plain<f32>>();
    agrees::<portable::Plain<f64>>();
    agrees::<<f32 as Real>::Base>();
    agrees::<<f64 as Real>::Base>();
}

#[cfg(target_arch = "x86_64")]
#[test]
fn avx2_gives_the_bits_of_the_scalar() {
    #[target_feature(enable = "avx2")]
    fn wide() {
        agrees::<<f32 as Real>::Avx2>();
        agrees::<<f64 as Real>::Avx2>();
    }
    if std::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2.
        unsafe { wide() }
    }
}

#[cfg(target_arch = "x86_64")]
#[test]
fn avx512_gives_the_bits_of_the_scalar() {
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw")]
    fn widest() {
        agrees::<<f32 as Real>::Avx512>();
        agrees::<<f64 as Real>::Avx512>();
    }
    if super::avx512::available() {
        // SAFETY: the processor has AVX-512.
        unsafe { widest() }
    }
}
