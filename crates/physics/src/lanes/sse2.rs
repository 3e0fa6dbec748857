//! Lanes in the 128-bit registers that every x86-64 has: two for f32, four for f64.

use std::arch::x86_64::*;

use super::{LANES, Lanes, in_quarters, operators};

/// Eight f32 in two registers.
#[derive(Debug, Clone, Copy)]
pub struct F32([__m128; 2]);
/// Eight f64 in four.
#[derive(Debug, Clone, Copy)]
pub struct F64([__m128d; 4]);

// SAFETY, here and below: SSE2 is part of x86-64; loads and stores go through references to eight numbers and need no alignment.
operators!(
    F32,
    |a, b| unsafe { _mm_add_ps(a, b) },
    unsafe { _mm_sub_ps(a, b) },
    unsafe { _mm_mul_ps(a, b) },
    unsafe { _mm_div_ps(a, b) },
    |c| unsafe { _mm_xor_ps(c, _mm_set1_ps(-0.0)) }
);
operators!(
    F64,
    |a, b| unsafe { _mm_add_pd(a, b) },
    unsafe { _mm_sub_pd(a, b) },
    unsafe { _mm_mul_pd(a, b) },
    unsafe { _mm_div_pd(a, b) },
    |c| unsafe { _mm_xor_pd(c, _mm_set1_pd(-0.0)) }
);

macro_rules! lanes {
    ($r:ty, $m:ty, $n:literal, $splat:ident, $load:ident, $store:ident, $sqrt:ident, $less:ident, $and:ident, $andnot:ident,
     $or:ident, $signs:ident) => {
        type Number = $r;
        type Mask = [$m; $n];
        #[inline(always)]
        fn splat(x: $r) -> Self {
            Self([unsafe { $splat(x) }; $n])
        }
        #[inline(always)]
        fn load(from: &[$r; LANES]) -> Self {
            Self(std::array::from_fn(|i| unsafe { $load(from.as_ptr().add(LANES / $n * i)) }))
        }
        #[inline(always)]
        fn store(self, to: &mut [$r; LANES]) {
            for (i, part) in self.0.into_iter().enumerate() {
                unsafe { $store(to.as_mut_ptr().add(LANES / $n * i), part) }
            }
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            Self(self.0.map(|x| unsafe { $sqrt(x) }))
        }
        #[inline(always)]
        fn less(self, other: Self) -> Self::Mask {
            std::array::from_fn(|i| unsafe { $less(self.0[i], other.0[i]) })
        }
        #[inline(always)]
        fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
            Self(std::array::from_fn(|i| unsafe { $or($and(mask[i], yes.0[i]), $andnot(mask[i], no.0[i])) }))
        }
        #[inline(always)]
        fn any(mask: Self::Mask) -> bool {
            mask.into_iter().any(|x| unsafe { $signs(x) } != 0)
        }
        #[inline(always)]
        fn both(a: Self::Mask, b: Self::Mask) -> Self::Mask {
            std::array::from_fn(|i| unsafe { $and(a[i], b[i]) })
        }
    };
}

impl Lanes for F32 {
    lanes!(
        f32,
        __m128,
        2,
        _mm_set1_ps,
        _mm_loadu_ps,
        _mm_storeu_ps,
        _mm_sqrt_ps,
        _mm_cmplt_ps,
        _mm_and_ps,
        _mm_andnot_ps,
        _mm_or_ps,
        _mm_movemask_ps
    );
    #[inline(always)]
    fn transpose(rows: [Self; 8]) -> [Self; 8] {
        in_quarters(rows.map(|r| r.0), quarter).map(Self)
    }
}

#[inline(always)]
fn quarter([a, b, c, d]: [__m128; 4]) -> [__m128; 4] {
    unsafe {
        let (ab0, ab1) = (_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
        let (cd0, cd1) = (_mm_unpacklo_ps(c, d), _mm_unpackhi_ps(c, d));
        [_mm_movelh_ps(ab0, cd0), _mm_movehl_ps(cd0, ab0), _mm_movelh_ps(ab1, cd1), _mm_movehl_ps(cd1, ab1)]
    }
}

impl Lanes for F64 {
    lanes!(
        f64,
        __m128d,
        4,
        _mm_set1_pd,
        _mm_loadu_pd,
        _mm_storeu_pd,
        _mm_sqrt_pd,
        _mm_cmplt_pd,
        _mm_and_pd,
        _mm_andnot_pd,
        _mm_or_pd,
        _mm_movemask_pd
    );
    #[inline(always)]
    fn transpose(rows: [Self; 8]) -> [Self; 8] {
        // sixteen blocks of 2 x 2
        std::array::from_fn(|j| {
            Self(std::array::from_fn(|i| {
                let (upper, lower) = (rows[2 * i].0[j / 2], rows[2 * i + 1].0[j / 2]);
                unsafe { if j % 2 == 0 { _mm_unpacklo_pd(upper, lower) } else { _mm_unpackhi_pd(upper, lower) } }
            }))
        })
    }
}
