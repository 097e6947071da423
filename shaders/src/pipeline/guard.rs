//! Errors of a device as values, where resources are made.

use std::cell::Cell;
use std::pin::pin;
use std::task::{Context, Poll, Waker};

use crate::Pass;

/// Why a device did not make what it was asked for.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// It has no memory left.
    #[error("the device has no memory left")]
    OutOfMemory,
    /// It, its driver or its shader compiler found fault with it: what they say, with the names of what they speak of.
    #[error("{0}")]
    Refused(String),
}

/// Runs what makes resources. The first error is returned as a value and does not reach the host's handler of uncaptured
/// errors. What was made must not be used then.
///
/// Errors are caught on this thread alone. In a browser they come later than this returns, and are let go.
///
/// # Errors
/// The device refused something.
pub fn guarded<T>(device: &wgpu::Device, make: impl FnOnce() -> T) -> Result<T, Refusal> {
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    let [validation, memory, internal] = [now(validation.pop()), now(memory.pop()), now(internal.pop())];
    // What could not be made for want of memory is invalid where it is used next, so memory is the cause.
    match memory.or(validation).or(internal) {
        _ if INJECTED.get() == Some(Injected::OutOfMemory) => Err(Refusal::OutOfMemory),
        None => Ok(made),
        Some(wgpu::Error::OutOfMemory { .. }) => Err(Refusal::OutOfMemory),
        Some(error) => Err(Refusal::Refused(error.to_string())),
    }
}

/// The answer if it is there.
fn now<T>(answer: impl Future<Output = Option<T>>) -> Option<T> {
    match pin!(answer).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(answer) => answer,
        Poll::Pending => None,
    }
}

/// Whether a device still makes resources: false once it was lost or destroyed. Tries, in a few microseconds.
pub fn is_alive(device: &wgpu::Device) -> bool {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let tried = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("sign of life"),
        size: 4,
        usage: wgpu::BufferUsages::MAP_WRITE,
        mapped_at_creation: true,
    });
    // One without memory is there.
    tried.get_mapped_range(..).is_ok() | now(memory.pop()).is_some()
}

/// Lets what has come back from a device be noted. Never waits; a lost device brings nothing back.
#[expect(clippy::disallowed_methods, reason = "`Poll` does not wait")]
pub(super) fn poll(device: &wgpu::Device) {
    let _ = device.poll(wgpu::PollType::Poll);
}

/// A fault to be tried out.
#[doc(hidden)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Injected {
    /// The shader of this name does not compile.
    Shader(&'static str),
    /// What is made under guard finds no memory.
    OutOfMemory,
}

thread_local! {
    static INJECTED: Cell<Option<Injected>> = const { Cell::new(None) };
}

/// Lets something fail on this thread, to see what becomes of it; `None` ends that.
#[doc(hidden)]
pub fn inject(fault: Option<Injected>) {
    INJECTED.set(fault);
}

/// The text of a pass.
pub(super) fn source(pass: &Pass) -> String {
    let mut text = pass.source();
    if INJECTED.get() == Some(Injected::Shader(pass.name)) {
        text.push_str("\nfn broken() -> u32 { return no_such_name; }");
    }
    text
}
