//! Parity: every operation of every width gives the bits of the plain number.

use super::{LANES, Lanes, Real, portable};

/// Numbers that tell roundings, signs, zeros and infinities apart.
fn samples<R: Real>() -> Vec<[R; LANES]> {
    let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
    let mut number = || {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        let mantissa = (bits >> 11) as f64 / (1u64 << 53) as f64;
        let power = [1e-12, 1e-6, 1.0, 1e3, 1e20][(bits % 5) as usize];
        if bits & 32 == 0 { mantissa * power } else { -mantissa * power }
    };
    let mut all: Vec<[R; LANES]> = (0..200).map(|_| std::array::from_fn(|_| R::from_f64(number()))).collect();
    let odd = [0.0, -0.0, 1.0, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 1e-40, -1e-40, 1e-310, -1e-310];
    all.extend((0..odd.len()).map(|k| std::array::from_fn(|i| R::from_f64(odd[(i + k) % odd.len()]))));
    all
}

fn bits<R: Real>(x: [R; LANES]) -> [u64; LANES] {
    // which NaN it is may differ, and matters to nothing
    x.map(|x| if x.to_f64().is_nan() { u64::MAX } else { x.to_f64().to_bits() })
}

fn stored<L: Lanes>(x: L) -> [u64; LANES] {
    let mut out = [L::Number::default(); LANES];
    x.store(&mut out);
    bits(out)
}

fn agree<L: Lanes, M: Lanes<Number = L::Number>>() {
    let all = samples::<L::Number>();
    for (x, y) in all.iter().zip(all.iter().rev()) {
        let (a, b) = (L::load(x), L::load(y));
        let (c, d) = (M::load(x), M::load(y));
        assert_eq!(stored(a + b), stored(c + d));
        assert_eq!(stored(a - b), stored(c - d));
        let (mut up, mut same, mut down, mut equal) = (a, c, a, c);
        up += b;
        same += d;
        down -= b;
        equal -= d;
        assert_eq!((stored(up), stored(down)), (stored(same), stored(equal)));
        assert_eq!(stored(a * b), stored(c * d));
        assert_eq!(stored(a / b), stored(c / d));
        assert_eq!(stored(-a), stored(-c));
        assert_eq!(stored(a.sqrt()), stored(c.sqrt()));
        assert_eq!(stored(L::select(a.less(b), a, b)), stored(M::select(c.less(d), c, d)));
        let (both, same) = (L::both(a.less(b), L::zero().less(a)), M::both(c.less(d), M::zero().less(c)));
        assert_eq!(stored(L::select(both, a, b)), stored(M::select(same, c, d)));
        assert_eq!(L::any(a.less(b)), M::any(c.less(d)));
        assert_eq!(stored(L::splat(x[3])), stored(M::splat(x[3])));
    }
    assert_eq!((stored(L::zero()), stored(L::number(0.1))), (stored(M::zero()), stored(M::number(0.1))));
    assert!(!L::any(L::zero().less(L::zero())));
    for lane in 0..LANES {
        // a mask that holds in one lane alone
        let one = std::array::from_fn(|i| L::Number::from_f64(if i == lane { -1.0 } else { 1.0 }));
        let mask = L::load(&one).less(L::zero());
        assert!(L::any(mask) && L::any(L::both(mask, mask)) && !L::any(L::both(mask, L::zero().less(L::load(&one)))));
        assert_eq!(
            stored(L::select(mask, L::number(3.0), L::number(4.0))),
            bits(one.map(|x| if x < L::Number::from_f64(0.0) { 3.0 } else { 4.0 }))
        );
    }
    for rows in all.chunks_exact(8) {
        let (one, two) =
            (L::transpose(std::array::from_fn(|i| L::load(&rows[i]))), M::transpose(std::array::from_fn(|i| M::load(&rows[i]))));
        for i in 0..8 {
            assert_eq!(stored(one[i]), stored(two[i]));
            assert_eq!(stored(one[i]), bits(std::array::from_fn(|j| rows[j][i])));
        }
    }
}

#[test]
fn all_widths_give_the_same_bits() {
    agree::<<f32 as Real>::Base, portable::Wide<f32>>();
    agree::<<f64 as Real>::Base, portable::Wide<f64>>();
    #[cfg(target_arch = "x86_64")]
    if std::is_x86_feature_detected!("avx2") {
        #[target_feature(enable = "avx2")]
        fn wide() {
            agree::<<f32 as Real>::Avx2, portable::Wide<f32>>();
            agree::<<f64 as Real>::Avx2, portable::Wide<f64>>();
        }
        // SAFETY: the processor has AVX2.
        unsafe { wide() }
    }
}
