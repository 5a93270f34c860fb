/** Files that the user saves. */

export function saveBlob(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement("a");
  link.href = url;
  link.download = fileName(name);
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export function saveText(text: string, type: string, name: string): void {
  saveBlob(new Blob([text], { type }), name);
}

export function saveCanvas(canvas: HTMLCanvasElement, name: string): void {
  canvas.toBlob((blob) => {
    if (blob) saveBlob(blob, name);
  }, "image/png");
}

/** A name that every file system takes. */
export function fileName(name: string): string {
  const plain = name.replace(/[^A-Za-z0-9._-]+/g, "_").replace(/^[._]+/, "");
  return plain === "" ? "placegraph" : plain.slice(0, 120);
}

/** An SVG text as PNG of `width` pixels; the picture is loaded as an image, so its scripts cannot run. */
export async function saveSvgAsPng(uri: string, width: number, name: string): Promise<void> {
  const image = new Image();
  image.src = uri;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = width;
  const share = image.naturalWidth > 0 ? image.naturalHeight / image.naturalWidth : 0.75;
  canvas.height = Math.max(1, Math.round(width * share));
  const context = canvas.getContext("2d");
  if (!context) return;
  context.fillStyle = "#ffffff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  saveCanvas(canvas, name);
}
