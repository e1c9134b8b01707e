//! The file: schemas and channels as they are first needed, whole chunks at a time.

use std::collections::BTreeMap;
use std::io::{Seek, Write};

use mcap::records::MessageHeader;
use mcap::{Attachment, Compression, WriteOptions, Writer};

use super::{RecordError, Recorded, descriptor};
use crate::ros2;

/// Messages that are collected before they are compressed and flushed, bytes. What was flushed survives a cut.
const CHUNK_BYTES: usize = 1 << 20;

/// How a topic's messages are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// Protobuf with a descriptor set.
    Protobuf,
    /// CDR of ROS 2 with the text of the message.
    Cdr,
}

/// A topic.
#[derive(Debug)]
pub(crate) struct Topic {
    /// Its name.
    pub(crate) name: &'static str,
    /// Full name of its messages.
    pub(crate) schema: &'static str,
    /// How they are written.
    pub(crate) encoding: Encoding,
    /// Whoever comes late is given the last message.
    pub(crate) latched: bool,
}

/// A recording being written. Dropped before its end it stays without a summary, as after a crash.
pub(crate) struct Output<W: Write + Seek> {
    writer: Option<Writer<W>>,
    /// Channel and messages so far, by topic.
    channels: BTreeMap<&'static str, (u16, u32)>,
    /// Bytes in the chunk that is open.
    open: usize,
    recorded: Recorded,
}

impl<W: Write + Seek> Output<W> {
    /// Begins a recording.
    pub(crate) fn new(out: W, profile: &str) -> Result<Self, RecordError> {
        let writer = WriteOptions::new()
            .profile(profile)
            .library(concat!("twin ", env!("CARGO_PKG_VERSION")))
            .compression(Some(Compression::Zstd))
            .compression_level(3)
            // frames of several threads depend on their number
            .compression_threads(0)
            // chunks are ended here, so that each is flushed
            .chunk_size(None)
            .create(out)?;
        let (channels, recorded) = (BTreeMap::new(), Recorded::default());
        Ok(Self { writer: Some(writer), channels, open: 0, recorded })
    }

    /// Attaches a file.
    pub(crate) fn attach(
        &mut self,
        ns: u64,
        name: &str,
        media_type: &str,
        bytes: &[u8],
    ) -> Result<(), RecordError> {
        let Some(writer) = &mut self.writer else { return Ok(()) };
        writer.attach(&Attachment {
            log_time: ns,
            create_time: ns,
            name: super::text::file_name(name),
            media_type: super::text::name(media_type),
            data: bytes.into(),
        })?;
        Ok(())
    }

    /// Notes keys and values.
    pub(crate) fn note(
        &mut self,
        name: &str,
        metadata: BTreeMap<String, String>,
    ) -> Result<(), RecordError> {
        let Some(writer) = &mut self.writer else { return Ok(()) };
        writer.write_metadata(&mcap::records::Metadata { name: name.to_owned(), metadata })?;
        Ok(())
    }

    /// Writes a message.
    pub(crate) fn put(
        &mut self,
        topic: &'static Topic,
        ns: u64,
        bytes: &[u8],
    ) -> Result<(), RecordError> {
        let Some(writer) = &mut self.writer else { return Ok(()) };
        let (channel_id, sequence) = match self.channels.get(topic.name) {
            Some(known) => *known,
            None => (channel(writer, topic)?, 0),
        };
        let header = MessageHeader { channel_id, sequence, log_time: ns, publish_time: ns };
        writer.write_to_known_channel(&header, bytes)?;
        self.channels.insert(topic.name, (channel_id, sequence.wrapping_add(1)));
        self.recorded.messages += 1;
        self.open += bytes.len();
        if self.open >= CHUNK_BYTES {
            self.open = 0;
            self.recorded.chunks += 1;
            writer.flush()?;
        }
        Ok(())
    }

    /// Ends the recording with its index.
    pub(crate) fn finish(mut self) -> Result<Recorded, RecordError> {
        if let Some(mut writer) = self.writer.take() {
            if self.open > 0 {
                self.recorded.chunks += 1;
            }
            let written = writer.finish();
            let mut out = writer.into_inner();
            written?;
            out.flush()?;
        }
        let topics = self.channels.iter().map(|(topic, (_, many))| (*topic, u64::from(*many)));
        self.recorded.topics = topics.collect();
        Ok(std::mem::take(&mut self.recorded))
    }
}

impl<W: Write + Seek> Drop for Output<W> {
    fn drop(&mut self) {
        // the writer of the crate would try to end the file
        if let Some(writer) = self.writer.take() {
            drop(writer.into_inner());
        }
    }
}

/// Makes the channel of a topic.
fn channel<W: Write + Seek>(writer: &mut Writer<W>, topic: &Topic) -> Result<u16, RecordError> {
    let mut metadata = BTreeMap::new();
    let (schema, message) = match topic.encoding {
        Encoding::Protobuf => ("protobuf", "protobuf"),
        Encoding::Cdr => {
            metadata.insert("offered_qos_profiles".to_owned(), ros2::qos(topic.latched));
            ("ros2msg", "cdr")
        }
    };
    let text = match topic.encoding {
        Encoding::Protobuf => descriptor::descriptor_set(topic.schema),
        Encoding::Cdr => ros2::schema(topic.schema).into_bytes(),
    };
    let id = writer.add_schema(topic.schema, schema, &text)?;
    Ok(writer.add_channel(id, topic.name, message, &metadata)?)
}
