//! Parity: every operation of every width gives the bits of the plain number.

use super::{Lanes, ROW, Real, Row, portable};

/// A line that every register is a part of.
const LINE: usize = 16;

/// Numbers that tell roundings, signs, zeros and infinities apart.
fn samples<R: Real>() -> Vec<[R; LINE]> {
    let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
    let mut number = || {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        let mantissa = (bits >> 11) as f64 / (1u64 << 53) as f64;
        let power = [1e-12, 1e-6, 1.0, 1e3, 1e20][(bits % 5) as usize];
        if bits & 32 == 0 { mantissa * power } else { -mantissa * power }
    };
    let mut all: Vec<[R; LINE]> = (0..200).map(|_| std::array::from_fn(|_| R::from_f64(number()))).collect();
    let odd = [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e-40, -1e-40, 1e-310, -1e-310];
    all.extend((0..odd.len()).map(|k| std::array::from_fn(|i| R::from_f64(odd[(i + k) % odd.len()]))));
    all
}

fn bits<R: Real>(x: [R; LINE]) -> [u64; LINE] {
    // which NaN it is may differ, and matters to nothing
    x.map(|x| if x.to_f64().is_nan() { u64::MAX } else { x.to_f64().to_bits() })
}

/// An operation on a line, part by part.
fn each<L: Lanes>(x: &[L::Number; LINE], y: &[L::Number; LINE], op: impl Fn(L, L) -> L) -> [u64; LINE] {
    let mut out = [L::Number::default(); LINE];
    for part in 0..LINE / L::WIDTH {
        op(L::load(x, part), L::load(y, part)).store(&mut out, part);
    }
    bits(out)
}

/// The same on each number alone.
fn plain<R: Real>(x: &[R; LINE], y: &[R; LINE], op: impl Fn(R, R) -> R) -> [u64; LINE] {
    bits(std::array::from_fn(|i| op(x[i], y[i])))
}

fn agrees<L: Lanes>() {
    let zero = L::Number::default();
    let all = samples::<L::Number>();
    for (x, y) in all.iter().zip(all.iter().rev()) {
        assert_eq!(each::<L>(x, y, |a, b| a + b), plain(x, y, |a, b| a + b));
        assert_eq!(each::<L>(x, y, |a, b| a - b), plain(x, y, |a, b| a - b));
        assert_eq!(each::<L>(x, y, |a, b| a * b), plain(x, y, |a, b| a * b));
        assert_eq!(each::<L>(x, y, |a, b| a / b), plain(x, y, |a, b| a / b));
        assert_eq!(each::<L>(x, y, |a, _| -a), plain(x, y, |a, _| -a));
        assert_eq!(each::<L>(x, y, |a, _| a.sqrt()), plain(x, y, |a, _| a.sqrt()));
        let add_assigned = |mut a: L, b: L| {
            a += b;
            a
        };
        let sub_assigned = |mut a: L, b: L| {
            a -= b;
            a
        };
        assert_eq!(each::<L>(x, y, add_assigned), plain(x, y, |a, b| a + b));
        assert_eq!(each::<L>(x, y, sub_assigned), plain(x, y, |a, b| a - b));
        assert_eq!(each::<L>(x, y, |a, b| L::select(a.less(b), a, b)), plain(x, y, |a, b| if a < b { a } else { b }));
        assert_eq!(each::<L>(x, y, |a, b| L::only(a.less(b), a)), plain(x, y, |a, b| if a < b { a } else { zero }));
        for part in 0..LINE / L::WIDTH {
            let lanes = L::WIDTH * part..L::WIDTH * (part + 1);
            let any = L::any(L::load(x, part).less(L::load(y, part)));
            assert_eq!(any, lanes.clone().any(|i| x[i] < y[i]));
            assert_eq!(bits([L::load(x, part).first(); LINE]), bits([x[lanes.start]; LINE]));
        }
        assert_eq!(each::<L>(x, y, |_, _| L::splat(x[3])), bits([x[3]; LINE]));
    }
    let x = &all[0];
    assert_eq!(each::<L>(x, x, |_, _| L::zero()), bits([zero; LINE]));
    assert_eq!(each::<L>(x, x, |_, _| L::number(0.1)), bits([L::Number::from_f64(0.1); LINE]));
    for lane in 0..LINE {
        // a mask that holds in one lane alone
        let one: [L::Number; LINE] = std::array::from_fn(|i| L::Number::from_f64(if i == lane { -1.0 } else { 1.0 }));
        for part in 0..LINE / L::WIDTH {
            let (there, mask) = (lane / L::WIDTH == part, L::load(&one, part).less(L::zero()));
            assert_eq!(L::any(mask), there);
        }
    }
    for rows in all.chunks_exact(LINE) {
        let row =
            |l: usize| -> [L::Number; ROW] { std::array::from_fn(|i| if i % 4 == 3 { zero } else { rows[l][i] }) };
        let columns = L::columns(|l| L::Row::read(&row(l)));
        for (i, column) in columns.into_iter().enumerate() {
            let mut out = [zero; LINE];
            column.store(&mut out, 0);
            assert_eq!(
                bits(out)[..L::WIDTH],
                bits(std::array::from_fn(|l| if l < L::WIDTH { row(l)[i] } else { zero }))[..L::WIDTH]
            );
        }
        let mut count = 0;
        for (l, back) in L::rows(columns).into_iter().enumerate() {
            let mut out = [zero; ROW];
            back.write(&mut out);
            assert_eq!(out.map(|x| x.to_f64().to_bits()), row(l).map(|x| x.to_f64().to_bits()));
            count += 1;
        }
        assert_eq!(count, L::WIDTH);
        let (a, b) = (L::Row::read(&row(0)), L::Row::read(&row(1)));
        let mut sums = [[zero; ROW]; 2];
        (a + b).write(&mut sums[0]);
        (a - b).write(&mut sums[1]);
        for (i, (x, y)) in row(0).into_iter().zip(row(1)).enumerate() {
            let same = |x: L::Number, y: L::Number| {
                x.to_f64().to_bits() == y.to_f64().to_bits() || x.to_f64().is_nan() && y.to_f64().is_nan()
            };
            assert!(same(sums[0][i], x + y) && same(sums[1][i], x - y));
        }
    }
}

#[test]
fn all_widths_give_the_bits_of_the_plain_number() {
    agrees::<portable::Plain<f32>>();
    agrees::<portable::Plain<f64>>();
    agrees::<<f32 as Real>::Base>();
    agrees::<<f64 as Real>::Base>();
}

#[cfg(target_arch = "x86_64")]
#[test]
fn avx2_gives_the_bits_of_the_plain_number() {
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
fn avx512_gives_the_bits_of_the_plain_number() {
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw")]
    fn widest() {
        agrees::<<f32 as Real>::Avx512>();
        agrees::<<f64 as Real>::Avx512>();
    }
    if super::avx512::available() {
        // SAFETY: the processor has it.
        unsafe { widest() }
    }
}
