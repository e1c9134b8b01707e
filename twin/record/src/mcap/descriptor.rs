//! Schemas of protobuf messages as data, and the descriptor set by which a reader decodes them.

use super::schemas;
use super::wire::Proto;

/// Type of a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `double`.
    Double,
    /// `int64`.
    Int64,
    /// `int32`.
    Int32,
    /// `uint32`.
    Uint32,
    /// `fixed32`.
    Fixed32,
    /// `bool`.
    Bool,
    /// `string`.
    Text,
    /// `bytes`.
    Bytes,
    /// A message by its full name.
    Message(&'static str),
    /// An enum inside the message, by its short name.
    Enum(&'static str),
}

/// How often a field occurs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Label {
    /// Once; absent means the default.
    Once,
    /// Once, and absence can be told from the default.
    Optional,
    /// Any number of times.
    Repeated,
}

/// One field.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Field {
    /// Its name.
    pub(crate) name: &'static str,
    /// Its number.
    pub(crate) number: u32,
    /// Its type.
    pub(crate) kind: Kind,
    /// How often it occurs.
    pub(crate) label: Label,
}

/// An enum inside a message: its name and its values.
pub(crate) type Enum = (&'static str, &'static [(&'static str, u64)]);

/// A message that has a file of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Message {
    /// Package and name.
    pub(crate) name: &'static str,
    /// Its fields, in the order of the published file.
    pub(crate) fields: &'static [Field],
    /// The enum it declares.
    pub(crate) enums: &'static [Enum],
}

/// The descriptor set of a message and all it refers to, each file after those it needs; empty for an unknown name.
pub(crate) fn descriptor_set(name: &str) -> Vec<u8> {
    let mut needed: Vec<&Message> = Vec::new();
    add_with_needs(name, &mut needed);
    Proto::default().messages(1, needed.into_iter().map(file)).into_bytes()
}

/// The message of a full name.
pub(crate) fn find(name: &str) -> Option<&'static Message> {
    schemas::ALL.iter().copied().find(|message| message.name == name)
}

fn add_with_needs(name: &str, needed: &mut Vec<&'static Message>) {
    let known = needed.iter().any(|message| message.name == name);
    let Some(message) = find(name).filter(|_| !known) else { return };
    for field in message.fields {
        if let Kind::Message(other) = field.kind {
            add_with_needs(other, needed);
        }
    }
    needed.push(message);
}

/// A `FileDescriptorProto`.
fn file(message: &Message) -> Proto {
    let (package, _) = split(message.name);
    let mut needs: Vec<&str> = Vec::new();
    for field in message.fields {
        if let Kind::Message(other) = field.kind
            && !needs.contains(&other)
        {
            needs.push(other);
        }
    }
    let named = Proto::default().text(1, &file_name(message.name)).text(2, package);
    let needing = needs.into_iter().fold(named, |proto, need| proto.text(3, &file_name(need)));
    needing.message(4, message_type(message)).text(12, "proto3")
}

/// A `DescriptorProto`.
fn message_type(message: &Message) -> Proto {
    let optional: Vec<&str> = message
        .fields
        .iter()
        .filter(|field| field.label == Label::Optional)
        .map(|field| field.name)
        .collect();
    let place = |field: &Field| optional.iter().position(|name| *name == field.name);
    let fields = message.fields.iter().map(|field| field_type(message, field, place(field)));
    // protobuf wants a "oneof" of one around every optional field
    let alone = optional.iter().map(|name| Proto::default().text(1, &format!("_{name}")));
    Proto::default()
        .text(1, split(message.name).1)
        .messages(2, fields)
        .messages(4, message.enums.iter().map(enum_type))
        .messages(8, alone)
}

/// A `FieldDescriptorProto`; `alone` is the place of its oneof.
fn field_type(message: &Message, field: &Field, alone: Option<usize>) -> Proto {
    let (kind, type_name) = match field.kind {
        Kind::Double => (1, None),
        Kind::Int64 => (3, None),
        Kind::Int32 => (5, None),
        Kind::Fixed32 => (7, None),
        Kind::Bool => (8, None),
        Kind::Text => (9, None),
        Kind::Message(name) => (11, Some(format!(".{name}"))),
        Kind::Bytes => (12, None),
        Kind::Uint32 => (13, None),
        Kind::Enum(name) => (14, Some(format!(".{}.{name}", message.name))),
    };
    let label = if field.label == Label::Repeated { 3 } else { 1 };
    let mut proto = Proto::default()
        .text(1, field.name)
        .uint(3, u64::from(field.number))
        .uint(4, label)
        .uint(5, kind);
    if let Some(type_name) = type_name {
        proto = proto.text(6, &type_name);
    }
    match alone {
        Some(place) => proto.uint(9, place as u64).uint(17, 1),
        None => proto,
    }
}

/// An `EnumDescriptorProto`.
fn enum_type((name, values): &Enum) -> Proto {
    let value = |(name, number): &(&str, u64)| Proto::default().text(1, name).uint(2, *number);
    Proto::default().text(1, name).messages(2, values.iter().map(value))
}

/// Package and short name.
fn split(name: &str) -> (&str, &str) {
    name.rsplit_once('.').unwrap_or(("", name))
}

fn file_name(name: &str) -> String {
    let (package, short) = split(name);
    // the well-known types are in files of small letters
    let short = if package == "google.protobuf" { short.to_lowercase() } else { short.to_owned() };
    format!("{}/{short}.proto", package.replace('.', "/"))
}
