// The contact of Hunt and Crossley with the exponent 1.5, as an environment in Rust
// (docs/environments.md).
//
//   rustc --edition 2021 --crate-type cdylib -O tissue.rs -o tissue.so
use std::ffi::{c_char, c_void};

#[repr(C)]
pub struct Motion {
    size: u32,
    axis: u32,
    axes: u32,
    reserved: u32,
    time_s: f64,
    position_m: f64,
    velocity_m_per_s: f64,
    other_position_m: f64,
    other_velocity_m_per_s: f64,
}

type Number = extern "C" fn(*const c_void, *const Motion) -> f64;

#[repr(C)]
pub struct Environment {
    abi: u32,
    size: u32,
    state_bytes: u32,
    parameter_count: u32,
    parameters: *const c_void,
    name: *const c_char,
    title: *const c_char,
    idea: *const c_char,
    equation: *const c_char,
    configure: *const c_void,
    reset: *const c_void,
    force: Number,
    advance: *const c_void,
    depth: Number,
    stiffness_hint: *const c_void,
}
unsafe impl Sync for Environment {}

extern "C" fn depth(_state: *const c_void, motion: *const Motion) -> f64 {
    unsafe { (*motion).position_m - 0.05 }
}

extern "C" fn force(state: *const c_void, motion: *const Motion) -> f64 {
    let depth_m = depth(state, motion);
    if !(depth_m > 0.0) {
        return 0.0;
    }
    let ratio = depth_m / 0.01;
    let spring_n = 5.0 * (ratio * ratio.sqrt());
    let force_n = spring_n * (1.0 + 0.5 * unsafe { (*motion).velocity_m_per_s });
    if force_n > 0.0 { force_n } else { 0.0 }
}

#[no_mangle]
pub static hapticwall_environment: Environment = Environment {
    abi: 1,
    size: std::mem::size_of::<Environment>() as u32,
    state_bytes: 0,
    parameter_count: 0,
    parameters: std::ptr::null(),
    name: c"tissue-rust".as_ptr(),
    title: c"Tissue in Rust".as_ptr(),
    idea: c"soft at the surface, stiffer with the depth".as_ptr(),
    equation: c"F_e = F_0 (p/p_0)^1.5 (1 + D v)".as_ptr(),
    configure: std::ptr::null(),
    reset: std::ptr::null(),
    force,
    advance: std::ptr::null(),
    depth,
    stiffness_hint: std::ptr::null(),
};
