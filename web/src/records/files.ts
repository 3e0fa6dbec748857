// Records as files: saved by a download, opened by dropping them on the page or from a dialog.

/** Longest record that is opened, bytes. */
const MAX_BYTES = 64_000_000;

export function saveFile(bytes: Uint8Array, name: string, type = 'application/octet-stream'): void {
  const address = URL.createObjectURL(new Blob([bytes as Uint8Array<ArrayBuffer>], { type }));
  const link = document.createElement('a');
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address));
}

/** Name of the file of a game that is saved today. */
export function fileName(turns: number): string {
  const day = new Date().toISOString().slice(0, 10);
  return `teeter-${day}-${turns}.record`;
}

/** Takes the content and the name of a file. */
export type OpenFile = (bytes: Uint8Array, name: string) => void;

/** Calls `open` with each file that is dropped on the page. */
export function listenToDrops(open: OpenFile): void {
  window.addEventListener('dragover', event => event.preventDefault());
  window.addEventListener('drop', event => {
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) void read(file).then(bytes => open(bytes, file.name));
  });
}

/** Lets the player choose a file. */
export function chooseFile(open: OpenFile): void {
  const input = document.createElement('input');
  input.type = 'file';
  input.addEventListener('change', () => {
    const file = input.files?.[0];
    if (file) void read(file).then(bytes => open(bytes, file.name));
  });
  input.click();
}

async function read(file: File): Promise<Uint8Array> {
  return new Uint8Array(await file.slice(0, MAX_BYTES).arrayBuffer());
}
