//! Lists the graphics adapters that wgpu finds here, one per line: kind, backend, name, driver.
//!
//! Exits with 1 when there is none. `cargo xtask test` reads this list to decide whether the tests have something to
//! run on.

use std::process::ExitCode;

fn main() -> ExitCode {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    for adapter in &adapters {
        let info = adapter.get_info();
        let kind = match info.device_type {
            wgpu::DeviceType::Cpu => "software",
            _ => "hardware",
        };
        println!("{kind}\t{}\t{}\t{} {}", info.backend, info.name, info.driver, info.driver_info);
    }
    if adapters.is_empty() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
