//! The JSON schema of report.json says what reports are.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;
use std::time::Instant;

use kenzan::check::Options;
use kenzan::document;
use kenzan::report::{self, json};
use kenzan::verify::{self, Request};
use serde_json::Value;

fn published() -> Value {
    serde_json::from_str(&json::schema().unwrap()).unwrap()
}

/// Reports with and without times, of notes with and without declarations, with and without diagnosis.
fn reports() -> Vec<Value> {
    let pool = rayon::ThreadPoolBuilder::new().stack_size(32 << 20).build().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    pool.install(|| {
        let options = Options { states: 3, ..Options::default() };
        let plain = Request { options: options.clone(), ..Request::default() };
        let only = ["1", "46", "56"].map(String::from).to_vec();
        let deep = Request { options, only, mutants: true, suggest: true, ..Request::default() };
        let report = |name: &str, request: &Request, times: bool| -> Value {
            let document = document::read(&root.join(name)).unwrap();
            let verified = [verify::verify(document, request, &|| ())];
            let options = report::Options { times, ..report::Options::default() };
            let text = json::render(&verify::run(&verified, request, Instant::now()), options).unwrap();
            serde_json::from_str(&text).unwrap()
        };
        vec![
            report("notes/gyroscope.md", &plain, true),
            report("notes/celestial-mechanics-3.md", &plain, false),
            report("tests/incremental/undeclared.md", &plain, true),
            report("notes/gyroscope.md", &deep, false),
        ]
    })
}

/// `INSTA_UPDATE=always cargo test --test schema` writes it anew.
#[test]
fn the_published_schema_is_that_of_this_version() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema/report.schema.json");
    let schema = json::schema().unwrap();
    if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
        std::fs::write(&path, &schema).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap(), schema, "write it anew with INSTA_UPDATE=always");
}

#[test]
fn reports_are_what_the_schema_says_and_every_key_is_described() {
    let schema = published();
    let validator = jsonschema::validator_for(&schema).unwrap();
    for report in reports() {
        let errors: Vec<String> =
            validator.iter_errors(&report).map(|e| format!("{}: {e}", e.instance_path())).take(5).collect();
        assert!(errors.is_empty(), "{errors:#?}");
        described(&schema, &schema, &report, "report");
    }
}

#[test]
fn a_report_with_a_wrong_type_is_none() {
    let validator = jsonschema::validator_for(&published()).unwrap();
    let path = Path::new("notes.md");
    let verified = [verify::verify(document::parse(path, "$$ 1 = 1 $$\n"), &Request::default(), &|| ())];
    let run = verify::run(&verified, &Request::default(), Instant::now());
    let report: Value = serde_json::from_str(&json::render(&run, report::Options::default()).unwrap()).unwrap();
    assert!(validator.is_valid(&report));
    let wrong = |pointer: &str, value: Value| {
        let mut report = report.clone();
        *report.pointer_mut(pointer).unwrap() = value;
        !validator.is_valid(&report)
    };
    assert!(wrong("/seed", "one".into()));
    assert!(wrong("/documents/0/equations/0/verdict", "perhaps".into()));
    assert!(wrong("/documents/0/equations/0/links", Value::Null));
    let mut without = report.clone();
    without["documents"][0]["equations"][0].as_object_mut().unwrap().remove("label");
    assert!(!validator.is_valid(&without), "a key that is missing");
}

/// Each key of each object is a property with a description.
fn described(root: &Value, schema: &Value, value: &Value, at: &str) {
    let schema = resolved(root, schema, value);
    match value {
        Value::Object(object) => {
            for (key, inner) in object {
                let property = &schema["properties"][key];
                let own = property.get("description").or_else(|| resolved(root, property, inner).get("description"));
                assert!(own.is_some(), "{at}.{key} is not described");
                described(root, property, inner, &format!("{at}.{key}"));
            }
        }
        Value::Array(items) => {
            let prefix = schema["prefixItems"].as_array();
            for (k, inner) in items.iter().enumerate() {
                let item = prefix.and_then(|prefix| prefix.get(k)).unwrap_or(&schema["items"]);
                described(root, item, inner, &format!("{at}[{k}]"));
            }
        }
        _ => {}
    }
}

/// What references and choices come to.
fn resolved<'s>(root: &'s Value, schema: &'s Value, value: &Value) -> &'s Value {
    if let Some(reference) = schema["$ref"].as_str() {
        return resolved(root, root.pointer(reference.trim_start_matches('#')).unwrap(), value);
    }
    match schema["anyOf"].as_array() {
        Some(choices) if !value.is_null() => {
            let other = choices.iter().find(|choice| choice["type"] != "null").unwrap();
            resolved(root, other, value)
        }
        _ => schema,
    }
}
