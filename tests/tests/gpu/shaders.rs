//! Every pass is parsed, validated, and compared with what Rust knows about it. Needs no adapter.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use open_water_shaders::{Pass, all};

/// WebGPU's default limits.
const WORKGROUP_BYTES: u32 = 16 * 1024;
const INVOCATIONS: u32 = 256;

fn parse(pass: &Pass) -> naga::Module {
    let source = pass.source();
    naga::front::wgsl::parse_str(&source)
        .unwrap_or_else(|error| panic!("{}: {}", pass.name, error.emit_to_string(&source)))
}

/// Overrides resolved to their defaults, as far as they have one; those without must be sizes, tried at 256.
fn resolve(pass: &Pass, module: &naga::Module, info: &naga::valid::ModuleInfo) -> naga::Module {
    let constants: naga::back::PipelineConstants = module
        .overrides
        .iter()
        .filter(|(_, o)| o.init.is_none())
        .map(|(_, o)| (o.name.clone().expect("an override without an id has a name"), 256.0))
        .collect();
    naga::back::pipeline_constants::process_overrides(module, info, None, &constants)
        .unwrap_or_else(|error| panic!("{}: overrides: {error:?}", pass.name))
        .0
        .into_owned()
}

#[test]
fn every_pass_is_valid_and_within_default_limits() {
    let mut count = 0;
    for pass in all() {
        count += 1;
        let module = parse(pass);
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        let info = validator
            .validate(&module)
            .unwrap_or_else(|error| panic!("{}: {}", pass.name, error.emit_to_string(&pass.source())));
        let resolved = resolve(pass, &module, &info);
        let resolved_info = validator.validate(&resolved).expect("resolved module is valid");

        let found: Vec<&str> = module.entry_points.iter().map(|entry| entry.name.as_str()).collect();
        assert!(!pass.entry_points.is_empty(), "{}: no entry points listed", pass.name);
        let mut expected = pass.entry_points.to_vec();
        let mut sorted = found.clone();
        expected.sort_unstable();
        sorted.sort_unstable();
        assert_eq!(sorted, expected, "{}: entry points", pass.name);

        for (index, entry) in resolved.entry_points.iter().enumerate() {
            if entry.stage != naga::ShaderStage::Compute {
                continue;
            }
            let invocations: u32 = entry.workgroup_size.iter().product();
            assert!(invocations <= INVOCATIONS, "{}: {} has {invocations} invocations", pass.name, entry.name);
            let usage = resolved_info.get_entry_point(index);
            let bytes: u32 = resolved
                .global_variables
                .iter()
                .filter(|(handle, variable)| {
                    variable.space == naga::AddressSpace::WorkGroup && !usage[*handle].is_empty()
                })
                .map(|(_, variable)| resolved.types[variable.ty].inner.size(resolved.to_ctx()))
                .sum();
            assert!(bytes <= WORKGROUP_BYTES, "{}: {} has {bytes} B of workgroup memory", pass.name, entry.name);
        }
    }
    assert!(count > 0, "the list of passes is empty");
}

#[test]
fn every_parameter_struct_has_the_same_layout_on_both_sides() {
    let mut count = 0;
    for pass in all() {
        let module = parse(pass);
        for layout in pass.params {
            count += 1;
            let place = format!("{}: struct {}", pass.name, layout.name);
            let (_, ty) = module
                .types
                .iter()
                .find(|(_, ty)| ty.name.as_deref() == Some(layout.name))
                .unwrap_or_else(|| panic!("{place}: not in the WGSL"));
            let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{place}: not a struct") };
            assert_eq!(*span as usize, layout.size, "{place}: size");
            let wgsl: Vec<(&str, usize)> = members
                .iter()
                .map(|member| (member.name.as_deref().unwrap_or(""), member.offset as usize))
                .filter(|(name, _)| !name.starts_with("pad"))
                .collect();
            let rust: Vec<(&str, usize)> = layout
                .fields
                .iter()
                .map(|field| (field.name, field.offset))
                .filter(|(name, _)| !name.starts_with("pad"))
                .collect();
            assert_eq!(wgsl, rust, "{place}: fields and offsets");
        }
    }
    assert!(count > 0, "no parameter struct is compared");
}

#[test]
fn names_are_unique() {
    let mut names: Vec<&str> = all().map(|pass| pass.name).collect();
    names.sort_unstable();
    let total = names.len();
    names.dedup();
    assert_eq!(names.len(), total, "two passes share a name");
}
