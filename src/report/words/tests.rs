use super::*;
use serde_json::Value;
use std::collections::{BTreeSet, HashSet};

fn table(language: Language) -> serde_json::Map<String, Value> {
    serde_json::to_value(language.words()).unwrap().as_object().unwrap().clone()
}

fn places(text: &str) -> BTreeSet<&str> {
    text.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0)).collect()
}

/// The compiler sees to it that both have all keys; what they say has the same places.
#[test]
fn the_languages_fill_the_same_places() {
    let (english, japanese) = (table(Language::English), table(Language::Japanese));
    assert!(english.len() > 100);
    for (key, text) in &english {
        let (text, other) = (text.as_str().unwrap(), japanese[key].as_str().unwrap());
        for form in text.split('|').chain(other.split('|')) {
            assert_eq!(places(form), places(text), "{key}: {form}");
        }
        assert!(text.split('|').count() <= 2 && !other.contains('|'), "{key}");
        assert!(!text.is_empty(), "{key}");
        // The wordless ones are the same; everything else has been translated.
        let words = text.chars().any(char::is_alphabetic) && key != "latex" && key != "equals" && key != "is";
        assert!(!words || text != other, "{key} is not translated");
    }
}

/// A template that asks for a word gets it, and no word is left that nobody asks for.
#[test]
fn templates_and_words_agree() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut asked = HashSet::new();
    for file in std::fs::read_dir(folder.join("templates")).unwrap() {
        let text = std::fs::read_to_string(file.unwrap().path()).unwrap();
        let word = |rest: &str| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().map(str::to_owned);
        let begins = |before: &str| before.chars().next_back().is_none_or(|c| !c.is_alphanumeric() && c != '_');
        asked.extend(
            text.match_indices("w.").filter(|(k, _)| begins(&text[..*k])).filter_map(|(k, _)| word(&text[k + 2..])),
        );
    }
    let table = table(Language::English);
    for key in &asked {
        assert!(table.contains_key(key), "no word `{key}`");
    }
    let mut code = std::fs::read_to_string(folder.join("src/report/words/mod.rs")).unwrap();
    for file in std::fs::read_dir(folder.join("src/report")).unwrap() {
        let path = file.unwrap().path();
        if path.is_file() {
            code.push_str(&std::fs::read_to_string(path).unwrap());
        }
    }
    for key in table.keys() {
        assert!(asked.contains(key) || code.contains(&format!(".{key}")), "nobody asks for `{key}`");
    }
}

#[test]
fn numbers_choose_the_form() {
    assert_eq!(
        ["{n} bit|{n} bits"; 3].map(|t| [count(t, 0), count(t, 1), count(t, 2)])[0],
        ["0 bits", "1 bit", "2 bits"]
    );
    assert_eq!(count("{n} 個", 1), "1 個");
    let hostile = "{n}|{m}";
    assert_eq!(with("a {x} b {y}", &[("x", &hostile), ("y", &1)]), "a {n}|{m} b 1");
}

#[test]
fn locales_have_a_language() {
    for (locale, tag) in
        [("ja_JP.UTF-8", "ja"), ("ja-JP", "ja"), ("JA", "ja"), ("C", "en"), ("de_DE", "en"), ("jam", "en"), ("", "en")]
    {
        assert_eq!(Language::of(locale).tag(), tag, "{locale}");
    }
}
