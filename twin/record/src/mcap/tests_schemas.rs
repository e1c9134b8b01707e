//! Messages against the descriptors they travel with, and against the published wire format.

use std::collections::BTreeSet;

use sim::film::Film;

use super::Profile;
use super::descriptor::{Kind, Label, descriptor_set, find};
use super::schemas;
use super::tests::{noise, read, with_pictures};
use super::wire::Proto;
use crate::sample;

/// Whether bytes are a message as its schema says; counts the fields met.
pub(super) fn fits(
    name: &str,
    mut bytes: &[u8],
    met: &mut BTreeSet<(&'static str, &'static str)>,
) -> Result<(), String> {
    let message = find(name).ok_or(format!("no schema {name}"))?;
    while !bytes.is_empty() {
        let key = varint(&mut bytes)?;
        let field = message.fields.iter().find(|field| u64::from(field.number) == key >> 3);
        let field = field.ok_or(format!("{name} has no field {}", key >> 3))?;
        met.insert((message.name, field.name));
        let packed = field.kind == Kind::Fixed32 && field.label == Label::Repeated;
        let wire = match field.kind {
            Kind::Double => 1,
            Kind::Int64 | Kind::Int32 | Kind::Uint32 | Kind::Bool | Kind::Enum(_) => 0,
            Kind::Fixed32 if !packed => 5,
            _ => 2,
        };
        if key & 7 != wire {
            return Err(format!("{name}.{} is written as {}", field.name, key & 7));
        }
        let len = match wire {
            0 => {
                varint(&mut bytes)?;
                continue;
            }
            1 => 8,
            5 => 4,
            _ => varint(&mut bytes)? as usize,
        };
        let (value, rest) = bytes.split_at_checked(len).ok_or("short".to_owned())?;
        bytes = rest;
        match field.kind {
            Kind::Message(inner) => fits(inner, value, met)?,
            Kind::Text => drop(std::str::from_utf8(value).map_err(|error| error.to_string())?),
            _ => {}
        }
    }
    Ok(())
}

fn varint(bytes: &mut &[u8]) -> Result<u64, String> {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let (first, rest) = bytes.split_first().ok_or("short".to_owned())?;
        *bytes = rest;
        value |= u64::from(first & 0x7F) << shift;
        if first & 0x80 == 0 {
            return Ok(value);
        }
    }
    Err("long varint".to_owned())
}

#[test]
fn every_message_fits_the_descriptor_it_travels_with() {
    let checked = sample::far();
    let tent = sample::tent();
    let mut met = BTreeSet::new();
    for checked in [checked, tent] {
        let film = Film::new(checked);
        let pictures = [(1.0, noise(10))];
        let (bytes, _) = with_pictures(checked, &film, Profile::Foxglove, &pictures);
        for (topic, schema, _, data) in read(&bytes).0 {
            fits(&schema, &data, &mut met).unwrap_or_else(|error| panic!("{topic}: {error}"));
        }
    }
    for wanted in [
        ("foxglove.LinePrimitive", "points"),
        ("foxglove.CylinderPrimitive", "top_scale"),
        ("foxglove.TextPrimitive", "text"),
        ("foxglove.JointState", "position"),
        ("foxglove.CompressedImage", "data"),
        ("foxglove.Log", "message"),
        ("foxglove.Event", "metadata"),
        ("twin.Metrics", "speed_m_s"),
        ("twin.Metrics", "joints"),
        ("twin.State", "phase"),
    ] {
        assert!(met.contains(&wanted), "{wanted:?} of {met:?}");
    }
}

#[test]
fn schemas_name_only_schemas() {
    for message in schemas::ALL {
        assert!(!descriptor_set(message.name).is_empty());
        let numbers: BTreeSet<u32> = message.fields.iter().map(|field| field.number).collect();
        assert_eq!(numbers.len(), message.fields.len(), "{}", message.name);
        for field in message.fields {
            match field.kind {
                Kind::Message(name) => assert!(find(name).is_some(), "{name}"),
                Kind::Enum(name) => assert!(message.enums.iter().any(|(known, _)| *known == name)),
                _ => {}
            }
        }
    }
    assert!(descriptor_set("foxglove.Nothing").is_empty());
}

#[test]
fn bytes_on_the_wire_are_those_of_the_protobuf_documentation() {
    assert_eq!(Proto::default().uint(1, 150).into_bytes(), [0x08, 0x96, 0x01]);
    let text = Proto::default().text(2, "testing").into_bytes();
    assert_eq!(text, [0x12, 0x07, 0x74, 0x65, 0x73, 0x74, 0x69, 0x6e, 0x67]);
    let inner = Proto::default().message(3, Proto::default().uint(1, 150)).into_bytes();
    assert_eq!(inner, [0x1a, 0x03, 0x08, 0x96, 0x01]);
    assert_eq!(Proto::default().double(1, 1.0).into_bytes(), [9, 0, 0, 0, 0, 0, 0, 0xF0, 0x3F]);
    assert_eq!(Proto::default().fixed32s(8, &[1, 2]).into_bytes()[..3], [0x42, 8, 1]);
    assert!(Proto::default().known(1, Some(f64::NAN)).known(2, None).into_bytes().is_empty());
}
