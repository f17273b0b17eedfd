//! The language server: equations that fail are underlined as one types.
//!
//! A text is verified again a moment after the last change of it, only what changed. What is asked of a text that has
//! changed since its equations were judged is not answered, rather than answered wrongly.

mod fix;
mod notes;
mod show;
mod text;

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tower_lsp_server::jsonrpc::{Error, Result};
use tower_lsp_server::ls_types::*;
use tower_lsp_server::{Client, LanguageServer, LspService, Server};

use crate::verify::Request;

use notes::{Judged, Notes};

/// How long nothing may be typed before a text is verified.
const QUIET: Duration = Duration::from_millis(150);
/// The command that searches what was meant: the document's address and the equation's label.
const SUGGEST: &str = "kenzan.suggest";

/// Serves on standard input and output until the editor ends it. `jobs` is the number of threads, 0 for one a core.
///
/// # Errors
/// Where threads cannot be had.
pub fn serve(request: Request, jobs: usize) -> std::io::Result<()> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs).stack_size(32 << 20).build();
    let pool = Arc::new(pool.map_err(std::io::Error::other)?);
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
    runtime.block_on(async {
        let (service, socket) =
            LspService::new(|client| Kenzan { client, texts: Arc::default(), request: Arc::new(request), pool });
        Server::new(tokio::io::stdin(), tokio::io::stdout(), socket).serve(service).await;
    });
    // Judgements that are under way are of no use to anybody any more.
    runtime.shutdown_background();
    Ok(())
}

#[derive(Clone)]
struct Kenzan {
    client: Client,
    texts: Arc<Mutex<HashMap<Uri, Arc<Notes>>>>,
    request: Arc<Request>,
    pool: Arc<rayon::ThreadPool>,
}

impl Kenzan {
    fn texts(&self) -> MutexGuard<'_, HashMap<Uri, Arc<Notes>>> {
        self.texts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn notes(&self, uri: &Uri) -> Option<Arc<Notes>> {
        self.texts().get(uri).cloned()
    }

    /// The judgements on a text, where it has not changed since.
    fn judged(&self, uri: &Uri) -> Option<(Arc<Notes>, Arc<Judged>)> {
        let notes = self.notes(uri)?;
        let judged = notes.judged()?;
        Some((notes, judged))
    }

    /// Verifies a text when nothing has been typed for a moment, and publishes what there is to underline.
    fn verify_soon(&self, uri: Uri, notes: Arc<Notes>, wait: Duration) {
        let kenzan = self.clone();
        let version = notes.version();
        tokio::spawn(async move {
            tokio::time::sleep(wait).await;
            if notes.version() != version {
                return;
            }
            let (request, again) = (Arc::clone(&kenzan.request), Arc::clone(&notes));
            let Some(judged) = kenzan.work(move || again.verify(&request)).await.flatten() else { return };
            if notes.version() == version {
                kenzan.publish(&uri, &notes, &judged, version).await;
            }
        });
    }

    async fn publish(&self, uri: &Uri, notes: &Notes, judged: &Judged, version: i32) {
        for (path, diagnostics) in show::diagnostics(&judged.verified) {
            let (file, version) = match path == notes.path {
                true => (Some(uri.clone()), Some(version)),
                false => (Uri::from_file_path(std::path::absolute(&path).unwrap_or(path)), None),
            };
            if let Some(file) = file {
                self.client.publish_diagnostics(file, diagnostics, version).await;
            }
        }
    }

    /// Works on the threads that have the stack for it; `None` where that broke down.
    async fn work<T: Send + 'static>(&self, work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
        let pool = Arc::clone(&self.pool);
        let caught = move || pool.install(|| crate::breakdown::caught(work).ok());
        tokio::task::spawn_blocking(caught).await.ok().flatten()
    }

    async fn suggest(&self, uri: Uri, label: String) -> Option<String> {
        let (notes, judged) = self.judged(&uri)?;
        let request = Arc::clone(&self.request);
        let found = self.work(move || judged.suggest(&label, &request).map(|n| (label, n))).await??;
        let (label, count) = found;
        // So that the editor asks for quick fixes again.
        if let Some(judged) = notes.judged() {
            self.publish(&uri, &notes, &judged, notes.version()).await;
        }
        Some(match count {
            0 => format!("no formula near ({label}) was found that holds"),
            1 => format!("a formula near ({label}) holds: see its quick fixes"),
            n => format!("{n} formulas near ({label}) hold: see its quick fixes"),
        })
    }
}

/// What a quick fix is to an editor.
fn action(uri: &Uri, range: Range, fix: fix::Fix) -> CodeActionOrCommand {
    let edit = TextEdit::new(range, fix.new);
    let edit = WorkspaceEdit { changes: Some(HashMap::from([(uri.clone(), vec![edit])])), ..WorkspaceEdit::default() };
    CodeActionOrCommand::CodeAction(CodeAction {
        title: fix.title,
        kind: Some(CodeActionKind::QUICKFIX),
        edit: Some(edit),
        is_preferred: fix.preferred.then_some(true),
        ..CodeAction::default()
    })
}

fn capabilities() -> ServerCapabilities {
    ServerCapabilities {
        text_document_sync: Some(TextDocumentSyncCapability::Kind(TextDocumentSyncKind::INCREMENTAL)),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        definition_provider: Some(OneOf::Left(true)),
        document_symbol_provider: Some(OneOf::Left(true)),
        code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
            code_action_kinds: Some(vec![CodeActionKind::QUICKFIX]),
            ..CodeActionOptions::default()
        })),
        execute_command_provider: Some(ExecuteCommandOptions {
            commands: vec![SUGGEST.into()],
            ..ExecuteCommandOptions::default()
        }),
        ..ServerCapabilities::default()
    }
}

impl LanguageServer for Kenzan {
    async fn initialize(&self, _: InitializeParams) -> Result<InitializeResult> {
        let version = Some(env!("CARGO_PKG_VERSION").to_owned());
        let server_info = Some(ServerInfo { name: "kenzan".into(), version });
        Ok(InitializeResult { capabilities: capabilities(), server_info, ..InitializeResult::default() })
    }

    async fn shutdown(&self) -> Result<()> {
        Ok(())
    }

    async fn did_open(&self, params: DidOpenTextDocumentParams) {
        let TextDocumentItem { uri, version, text, .. } = params.text_document;
        let path = uri.to_file_path().map_or_else(|| PathBuf::from("notes.md"), |path| path.into_owned());
        let notes = Arc::new(Notes::new(path, text, version));
        self.texts().insert(uri.clone(), Arc::clone(&notes));
        self.verify_soon(uri, notes, Duration::ZERO);
    }

    async fn did_change(&self, params: DidChangeTextDocumentParams) {
        let VersionedTextDocumentIdentifier { uri, version } = params.text_document;
        let Some(notes) = self.notes(&uri) else { return };
        notes.edit(version, &params.content_changes);
        self.verify_soon(uri, notes, QUIET);
    }

    async fn did_save(&self, params: DidSaveTextDocumentParams) {
        // Files that it includes may have changed.
        let uri = params.text_document.uri;
        let Some(notes) = self.notes(&uri) else { return };
        self.verify_soon(uri, notes, Duration::ZERO);
    }

    async fn did_close(&self, params: DidCloseTextDocumentParams) {
        let uri = params.text_document.uri;
        self.texts().remove(&uri);
        self.client.publish_diagnostics(uri, Vec::new(), None).await;
    }

    async fn hover(&self, params: HoverParams) -> Result<Option<Hover>> {
        let TextDocumentPositionParams { text_document, position } = params.text_document_position_params;
        let Some((_, judged)) = self.judged(&text_document.uri) else { return Ok(None) };
        let request = Arc::clone(&self.request);
        let shown = self.work(move || judged.hover(position, &request)).await.flatten();
        Ok(shown.map(|(value, range)| Hover {
            contents: HoverContents::Markup(MarkupContent { kind: MarkupKind::Markdown, value }),
            range: Some(range),
        }))
    }

    async fn goto_definition(&self, params: GotoDefinitionParams) -> Result<Option<GotoDefinitionResponse>> {
        let TextDocumentPositionParams { text_document, position } = params.text_document_position_params;
        let range = self.judged(&text_document.uri).and_then(|(_, judged)| judged.definition(position));
        Ok(range.map(|range| GotoDefinitionResponse::Scalar(Location::new(text_document.uri, range))))
    }

    async fn document_symbol(&self, params: DocumentSymbolParams) -> Result<Option<DocumentSymbolResponse>> {
        let symbols = self.judged(&params.text_document.uri).map(|(_, judged)| judged.symbols());
        Ok(symbols.map(DocumentSymbolResponse::Nested))
    }

    async fn code_action(&self, params: CodeActionParams) -> Result<Option<CodeActionResponse>> {
        let uri = params.text_document.uri;
        let Some((_, judged)) = self.judged(&uri) else { return Ok(None) };
        let mut actions = Vec::new();
        for (label, fixes) in judged.fixes(params.range) {
            actions.extend(fixes.into_iter().filter_map(|fix| Some(action(&uri, judged.range(&fix.span)?, fix))));
            if let Some(label) = label {
                let title = format!("Search what was meant by ({label})");
                let arguments = vec![uri.as_str().into(), label.into()];
                actions.push(CodeActionOrCommand::Command(Command::new(title, SUGGEST.into(), Some(arguments))));
            }
        }
        Ok(Some(actions))
    }

    async fn execute_command(&self, params: ExecuteCommandParams) -> Result<Option<LSPAny>> {
        let text = |k: usize| params.arguments.get(k).and_then(|a| a.as_str()).map(str::to_owned);
        let uri = text(0).and_then(|uri| uri.parse::<Uri>().ok());
        let (Some(uri), Some(label), SUGGEST) = (uri, text(1), params.command.as_str()) else {
            return Err(Error::invalid_params("expected kenzan.suggest with a document's address and a label"));
        };
        let told = self.suggest(uri, label).await;
        let told = told.unwrap_or_else(|| "the text has changed since it was verified: try again".into());
        self.client.show_message(MessageType::INFO, &told).await;
        Ok(Some(told.into()))
    }
}
