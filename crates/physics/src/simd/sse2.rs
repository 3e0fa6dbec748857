//! SSE2 registers (128 bits), which every x86-64 has.

use std::arch::x86_64::*;

use super::register::{register, transpose_fours, transpose_twos};

register! {
    /// Register of four f32.
    F32: 4 x f32 => __m128, mask __m128;
    _mm_set1_ps; _mm_loadu_ps; _mm_storeu_ps; _mm_sqrt_ps;
    _mm_add_ps; _mm_sub_ps; _mm_mul_ps; _mm_div_ps; |x| _mm_xor_ps(x, _mm_set1_ps(-0.0)); _mm_min_ps;
    _mm_cmplt_ps; |m, yes, no| _mm_or_ps(_mm_and_ps(m, yes), _mm_andnot_ps(m, no)); _mm_and_ps; |m| _mm_movemask_ps(m) != 0
}
register! {
    /// Register of two f64.
    F64: 2 x f64 => __m128d, mask __m128d;
    _mm_set1_pd; _mm_loadu_pd; _mm_storeu_pd; _mm_sqrt_pd;
    _mm_add_pd; _mm_sub_pd; _mm_mul_pd; _mm_div_pd; |x| _mm_xor_pd(x, _mm_set1_pd(-0.0)); _mm_min_pd;
    _mm_cmplt_pd; |m, yes, no| _mm_or_pd(_mm_and_pd(m, yes), _mm_andnot_pd(m, no)); _mm_and_pd; |m| _mm_movemask_pd(m) != 0
}

transpose_fours!(F32, f32, transpose4);
transpose_twos!(F64, f64, |a, b| unsafe { _mm_unpacklo_pd(a, b) }, |a, b| unsafe { _mm_unpackhi_pd(a, b) });

#[inline(always)]
fn transpose4([a, b, c, d]: [__m128; 4]) -> [__m128; 4] {
    // SAFETY: SSE2 is part of x86-64.
    unsafe {
        let (ab0, ab1) = (_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
        let (cd0, cd1) = (_mm_unpacklo_ps(c, d), _mm_unpackhi_ps(c, d));
        [_mm_movelh_ps(ab0, cd0), _mm_movehl_ps(cd0, ab0), _mm_movelh_ps(ab1, cd1), _mm_movehl_ps(cd1, ab1)]
    }
}
